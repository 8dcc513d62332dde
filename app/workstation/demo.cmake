# What `dottrack demo` is made of, beside its command.
dottrack_library(workstation_accuracy SOURCES accuracy.cpp tum_reader.cpp
  USES dottrack::hal_base Eigen3::Eigen fmt::fmt)
list(APPEND workstation_uses dottrack::workstation_accuracy dottrack::host_sim_scenarios)
