# What `dottrack target` is made of, beside its command.
add_subdirectory(target)
list(APPEND workstation_uses dottrack::workstation_target)
