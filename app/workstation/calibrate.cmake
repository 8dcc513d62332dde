# What `dottrack calibrate` is made of, beside its command.
add_subdirectory(calibrate)
list(APPEND workstation_uses dottrack::workstation_calibrate)
