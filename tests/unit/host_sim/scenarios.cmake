dottrack_test(host_sim_scenarios_test
  SOURCES scene_files_test.cpp scenario_file_test.cpp
  USES dottrack::host_sim_scenarios dottrack::config dottrack::test_support)
dottrack_test(host_sim_hal_test
  SOURCES sim_can_bus_test.cpp sim_frame_grabber_test.cpp sim_iris_test.cpp
  USES dottrack::host_sim_hal dottrack::test_support)
