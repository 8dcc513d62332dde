# What `dottrack survey` and the repair of moved cameras are made of, beside their commands.
add_subdirectory(survey)
list(APPEND workstation_uses dottrack::workstation_survey)
add_subdirectory(calibrate/repair)
list(APPEND workstation_uses dottrack::workstation_calibrate_repair)
