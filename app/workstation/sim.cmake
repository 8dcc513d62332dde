# What `dottrack sim` and `dottrack experiments` are made of, beside their commands.
dottrack_library(workstation_figures
  SOURCES straightness.cpp svg_chart.cpp truth_record.cpp
  USES dottrack::workstation_outputs)
