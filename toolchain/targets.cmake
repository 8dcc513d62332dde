# One target a folder: the folder tree is the architecture.

# dottrack_library(NAME [SOURCES file...] [USES target...]): dottrack::NAME; header-only without SOURCES.
function(dottrack_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  if(ARG_SOURCES)
    add_library(dottrack_${name} STATIC ${ARG_SOURCES})
    target_include_directories(dottrack_${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(dottrack_${name} PUBLIC ${ARG_USES} PRIVATE dottrack_warnings)
    dottrack_read_precompiled(dottrack_${name} precompiled)
  else()
    add_library(dottrack_${name} INTERFACE)
    target_include_directories(dottrack_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(dottrack_${name} INTERFACE ${ARG_USES})
  endif()
  add_library(dottrack::${name} ALIAS dottrack_${name})
endfunction()

# dottrack_quick_target(TARGET): its sources are many lines around few instructions; optimising them,
# or a sanitizer's checks in them, takes longer than running them ever does.
function(dottrack_quick_target target)
  target_compile_options(${target} PRIVATE ${dottrack_quick})
  dottrack_read_precompiled(${target} precompiled_quick)
endfunction()

# dottrack_test(NAME [COMPUTES] SOURCES file... [USES target...] [LABELS label...]): one GoogleTest
# program, registered test by test. Under a sanitizer there is none with the label `slow`; with the label
# `shipped` it runs both there and as it is shipped. COMPUTES: its own code has so much to compute, a slow reference
# say, that it is optimised, with a sanitizer too. The target tests_LABEL builds all programs of that label; the label
# `threads` is for tests that start threads and so run under the thread sanitizer too.
set(test_discovery POST_BUILD)
if(CMAKE_CROSSCOMPILING)
  set(test_discovery PRE_TEST)  # the machine that builds may not be able to run them
endif()
function(dottrack_test name)
  cmake_parse_arguments(ARG "COMPUTES" "" "SOURCES;USES;LABELS" ${ARGN})
  if(DOTTRACK_SANITIZE AND "slow" IN_LIST ARG_LABELS)
    return()
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_USES} GTest::gmock GTest::gtest_main dottrack_warnings)
  target_compile_definitions(${name} PRIVATE DOTTRACK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(ARG_COMPUTES)
    dottrack_read_precompiled(${name} precompiled_tests)
  else()
    target_compile_options(${name} PRIVATE ${dottrack_quick})
    dottrack_read_precompiled(${name} precompiled_tests_quick)
  endif()
  set(properties TIMEOUT 600)
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
    DISCOVERY_MODE ${test_discovery} PROPERTIES ${properties})
  foreach(label ${ARG_LABELS})
    if(NOT TARGET tests_${label})
      add_custom_target(tests_${label})
    endif()
    add_dependencies(tests_${label} ${name})
  endforeach()
endfunction()
