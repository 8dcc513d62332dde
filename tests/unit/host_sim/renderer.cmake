dottrack_test(host_sim_renderer_test
  SOURCES renderer_bodies_test.cpp renderer_light_test.cpp renderer_marks_test.cpp
  USES dottrack::host_sim_renderer)
