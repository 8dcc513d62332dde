# DOTTRACK_SANITIZE = "" | "address,undefined" | "thread"
set(DOTTRACK_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize=")
if(DOTTRACK_SANITIZE)
  # Instrumented Eigen code at -O2 with variable tracking takes five times as long to compile;
  # file and line of a finding need neither. Assertions stay on.
  add_compile_options(-fsanitize=${DOTTRACK_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -O1 -g1 -fno-var-tracking -UNDEBUG)
  # Instrumentation hides initialisations from this warning: it then sees faults in the standard
  # library that are none. The other builds keep it.
  add_compile_options(-Wno-error=maybe-uninitialized)
  add_link_options(-fsanitize=${DOTTRACK_SANITIZE})
endif()
