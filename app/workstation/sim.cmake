# What `dottrack sim` and `dottrack experiments` are made of, beside their commands.
dottrack_library(workstation_figures
  SOURCES light_tally.cpp straightness.cpp svg_chart.cpp truth_record.cpp xml_text.cpp
  USES dottrack::workstation_outputs)
dottrack_library(workstation_sim
  SOURCES consistency.cpp experiment_figures.cpp experiment_table.cpp experiments.cpp interrupt.cpp light_figures.cpp progress.cpp
          sim_plots.cpp sim_run.cpp status_line.cpp trial.cpp trial_file.cpp
          trial_summary.cpp trials.cpp
  USES dottrack::workstation_figures dottrack::workstation_replay dottrack::host_sim_scenarios
       dottrack::host_sim_hal dottrack::workstation_calibrate)
list(APPEND workstation_uses dottrack::workstation_sim)
