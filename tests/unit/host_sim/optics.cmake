dottrack_test(host_sim_optics_test
  SOURCES camera_text_test.cpp sensor_test.cpp sim_camera_test.cpp ../geometry/table.cpp
  USES dottrack::host_sim_renderer dottrack::config dottrack::core_geometry dottrack::test_support)

