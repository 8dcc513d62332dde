# The fuzz targets and what they use, built by clang for its fuzzer: sanitizers on, coverage counted.
option(DOTTRACK_FUZZ "Build the fuzz targets, and no other test (needs clang)" OFF)
if(DOTTRACK_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "DOTTRACK_FUZZ takes clang; here is ${CMAKE_CXX_COMPILER_ID}. "
                        "cmake --preset fuzz chooses it.")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer
    -fno-sanitize-recover=all -UNDEBUG)
  add_link_options(-fsanitize=address,undefined)
endif()
