# What `dottrack replay` is made of, beside its command. Links the allocation trap into the program.
find_package(PNG REQUIRED)
dottrack_library(workstation_outputs
  SOURCES run_tally.cpp report_file.cpp canvas.cpp
          bitmap_font.cpp explainer.cpp json_object.cpp overlay.cpp reason_words.cpp
  USES dottrack::config dottrack::core dottrack::telemetry fmt::fmt PNG::PNG)
target_compile_definitions(dottrack_workstation_outputs PRIVATE
  DOTTRACK_BUILD_TYPE="$<CONFIG>")
dottrack_library(workstation_replay SOURCES loop_files.cpp loop_run.cpp replay.cpp
  USES dottrack::workstation_outputs dottrack::cycle dottrack::drivers_recorded
       dottrack::drivers_candump dottrack::rtos_virtual_time dottrack::rtos_posix_rt
       dottrack::allocation_trap)
list(APPEND workstation_uses dottrack::workstation_replay)
