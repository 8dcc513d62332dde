# What `dottrack monitor`, `dottrack command` and `dottrack dbc` are made of, beside their commands.
add_subdirectory(dbc)
add_subdirectory(mavlink)
add_subdirectory(monitor)
dottrack_library(workstation_addressing SOURCES addressing_options.cpp
  USES dottrack::hal_base CLI11::CLI11 fmt::fmt)
list(APPEND workstation_uses dottrack::workstation_monitor dottrack::workstation_addressing)
