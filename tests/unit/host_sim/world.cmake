dottrack_test(host_sim_world_test
  SOURCES world_hall_test.cpp world_meshes_test.cpp world_motions_test.cpp world_terrain_test.cpp
    world_test.cpp
  USES dottrack::host_sim_world)
