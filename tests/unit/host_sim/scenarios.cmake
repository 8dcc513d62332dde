dottrack_test(host_sim_scenarios_test
  SOURCES calibration_files_test.cpp placements_test.cpp scene_files_test.cpp scenario_file_test.cpp
  USES dottrack::host_sim_scenarios dottrack::config dottrack::test_support)
dottrack_test(host_sim_scene_renderer_test
  SOURCES scene_renderer_test.cpp
  USES dottrack::host_sim_scenarios LABELS threads)
dottrack_test(host_sim_hal_test
  SOURCES frame_recorder_test.cpp sim_can_bus_test.cpp sim_frame_grabber_test.cpp sim_iris_test.cpp
  USES dottrack::host_sim_hal dottrack::core_protocol dottrack::drivers_recorded dottrack::test_support)
