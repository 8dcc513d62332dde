# Headers of libraries, compiled once for each set of flags and read by all targets with those flags.
# With them a source compiles that names too few headers, so `dev` and what the unit runs have none:
# docs/adr/0024 and 0040.
option(DOTTRACK_PRECOMPILE "Precompile the headers of libraries" OFF)
set(precompiled_headers
  <algorithm> <array> <cmath> <cstdint> <functional> <memory> <optional> <span> <string>
  <string_view> <utility> <vector>
  <Eigen/Core> <Eigen/Geometry> <boost/container/static_vector.hpp> <fmt/format.h>
  <tl/expected.hpp>)
set(precompiled_test_headers <filesystem> <fstream> <map> <random> <set> <sstream> <thread>
  <gmock/gmock.h> <gtest/gtest.h>)

# What headers were precompiled with is what their readers are compiled with, or g++ refuses them.
add_library(dottrack_precompiled INTERFACE)
foreach(library Eigen3::Eigen Boost::headers fmt::fmt tl::expected)
  target_include_directories(dottrack_precompiled SYSTEM INTERFACE
    $<TARGET_PROPERTY:${library},INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_definitions(dottrack_precompiled INTERFACE
    $<TARGET_PROPERTY:${library},INTERFACE_COMPILE_DEFINITIONS>)
endforeach()

# g++ 12 takes the standard library's lines in precompiled headers for ours, and warns of them.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(dottrack_precompiled INTERFACE
    -Wno-error=array-bounds -Wno-error=stringop-overflow -Wno-error=restrict)
endif()

# How code is compiled that is many lines around few instructions.
set(dottrack_quick -O1)
if(DOTTRACK_SANITIZE)
  set(dottrack_quick -O0)
endif()

function(dottrack_precompile name)
  cmake_parse_arguments(ARG "QUICK" "" "HEADERS;USES" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_USES} dottrack_precompiled dottrack_warnings)
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  if(ARG_QUICK)
    target_compile_options(${name} PRIVATE ${dottrack_quick})
  endif()
endfunction()

if(DOTTRACK_PRECOMPILE)
  dottrack_precompile(precompiled HEADERS ${precompiled_headers})
  dottrack_precompile(precompiled_quick QUICK HEADERS ${precompiled_headers})
  if(DOTTRACK_TESTS)
    find_package(GTest REQUIRED)
    set(for_tests HEADERS ${precompiled_headers} ${precompiled_test_headers}
        USES GTest::gmock GTest::gtest)
    dottrack_precompile(precompiled_tests ${for_tests})
    dottrack_precompile(precompiled_tests_quick QUICK ${for_tests})
  endif()
endif()

# dottrack_read_precompiled(TARGET NAME): the last call for a target counts. A target with sources in C
# does without.
function(dottrack_read_precompiled target name)
  get_target_property(sources ${target} SOURCES)
  if(DOTTRACK_PRECOMPILE AND NOT sources MATCHES "\\.c(;|$)")
    target_link_libraries(${target} PRIVATE dottrack_precompiled)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()
