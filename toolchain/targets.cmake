# One target a folder: the folder tree is the architecture.

# dottrack_library(NAME [SOURCES file...] [USES target...]): dottrack::NAME; header-only without SOURCES.
function(dottrack_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  if(ARG_SOURCES)
    add_library(dottrack_${name} STATIC ${ARG_SOURCES})
    target_include_directories(dottrack_${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(dottrack_${name} PUBLIC ${ARG_USES} PRIVATE dottrack_warnings)
  else()
    add_library(dottrack_${name} INTERFACE)
    target_include_directories(dottrack_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(dottrack_${name} INTERFACE ${ARG_USES})
  endif()
  add_library(dottrack::${name} ALIAS dottrack_${name})
endfunction()

# dottrack_test(NAME SOURCES file... [USES target...]): one GoogleTest program, registered test by test.
function(dottrack_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_USES} GTest::gmock GTest::gtest_main dottrack_warnings)
  target_compile_definitions(${name} PRIVATE DOTTRACK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
