# DOTTRACK_SANITIZE = "" | "address,undefined" | "thread". Clang compiles instrumented Eigen in about
# half of the time g++ takes: docs/adr/0040.
set(DOTTRACK_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize=")
if(DOTTRACK_SANITIZE)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "DOTTRACK_SANITIZE takes clang; here is ${CMAKE_CXX_COMPILER_ID}. "
                        "The presets asan-ubsan and tsan choose it.")
  endif()
  # File and line of a finding need no more of the debugger's words. Assertions stay on.
  add_compile_options(-fsanitize=${DOTTRACK_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -O1 -g1 -UNDEBUG)
  # A third of the time to compile: a stray or null pointer is the address sanitizer's to find, and
  # both processors load from any address.
  if(DOTTRACK_SANITIZE MATCHES undefined)
    add_compile_options(-fno-sanitize=null,object-size,alignment)
  endif()
  # Vectors emulated lane by lane take a minute a source to compile with checks; release tests those.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    add_compile_options(-mssse3)
  endif()
  string(TOUPPER ${DOTTRACK_SANITIZE} sanitizers)
  string(REPLACE "," ";DOTTRACK_SANITIZES_" sanitizers ${sanitizers})
  add_compile_definitions(DOTTRACK_SANITIZES_${sanitizers})
  add_link_options(-fsanitize=${DOTTRACK_SANITIZE})
endif()
