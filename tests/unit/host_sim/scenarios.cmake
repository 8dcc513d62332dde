dottrack_test(host_sim_scenarios_test
  SOURCES scene_files_test.cpp scenario_file_test.cpp
  USES dottrack::host_sim_scenarios dottrack::config dottrack::test_support)
