# How Cairn's targets are made: libraries of the rooms, modules, tests.

# Warnings and sanitizers, for our own targets only (never exported).
add_library(cairn_private_options INTERFACE)
target_compile_options(cairn_private_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                                       -Wno-sign-conversion -fno-math-errno)
# GCC 12 warns falsely on std::string concatenation (bug 105651), and of uninitialized values in inlined unity sources.
target_compile_options(cairn_private_options INTERFACE
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>)
if(NOT CAIRN_SANITIZERS)
  # What a fault in memory can do: little. tests/architecture/hardened.sh looks at what was built.
  target_compile_options(cairn_private_options INTERFACE
                         -fstack-protector-strong -fstack-clash-protection
                         $<$<CONFIG:Release,RelWithDebInfo>:-D_FORTIFY_SOURCE=2>)
  target_link_options(cairn_private_options INTERFACE -Wl,-z,relro,-z,now,-z,noexecstack)
endif()
if(CAIRN_SANITIZERS)
  # Undefined behaviour that is only reported lets a test pass.
  target_compile_options(cairn_private_options INTERFACE -fsanitize=${CAIRN_SANITIZERS} -fno-sanitize-recover=all
                                                         -fno-omit-frame-pointer)
  target_link_options(cairn_private_options INTERFACE -fsanitize=${CAIRN_SANITIZERS})
endif()

include(${CMAKE_CURRENT_LIST_DIR}/cairn_add_module.cmake)

# cairn_add_room(NAME SOURCES ... [USES rooms...] [PRIVATE ...]): the sources of one room, as objects of the library
# that cairn_add_library(... ROOMS ...) or cairn_add_module(... ROOMS ...) makes of several. USES are the arrows that tests/architecture checks.
function(cairn_add_room name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES;PRIVATE" ${ARGN})
  add_library(cairn_${name} OBJECT ${arg_SOURCES})
  target_compile_features(cairn_${name} PUBLIC cxx_std_20)
  target_include_directories(cairn_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  list(TRANSFORM arg_USES PREPEND cairn_)
  target_link_libraries(cairn_${name} PUBLIC Eigen3::Eigen ${arg_USES} PRIVATE cairn_private_options ${arg_PRIVATE})
endfunction()

# cairn_add_library(cairn_NAME [ROOMS ...] [SOURCES ...] [PUBLIC ...] [PRIVATE ...]): a shared library, for others
# cairn::NAME.
function(cairn_add_library name)
  cmake_parse_arguments(arg "" "" "ROOMS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  list(TRANSFORM arg_ROOMS PREPEND cairn_)
  add_library(${name} SHARED ${arg_SOURCES})
  string(REGEX REPLACE "^cairn_" "" short_name ${name})
  add_library(cairn::${short_name} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                            $<INSTALL_INTERFACE:include/cairn>)
  target_link_libraries(${name} PUBLIC Eigen3::Eigen ${arg_PUBLIC} PRIVATE ${arg_ROOMS} cairn_private_options ${arg_PRIVATE})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${short_name} INSTALL_RPATH "$ORIGIN" BUILD_WITH_INSTALL_RPATH ON
                                           SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  cairn_export_only(${name} library)
endfunction()

# How a test's own code is optimized: half the time to compile it, and hardly any to run it.
function(cairn_test_options name)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${name} PRIVATE -O1)
  elseif(CAIRN_SANITIZERS)
    target_compile_options(${name} PRIVATE -O0)
  endif()
endfunction()

# cairn_add_test(NAME SOURCES ... [ALONE ...] [LINK ...] [SHARDS N] [SLOW_ORACLE]): one GoogleTest program, run as one
# test, or as N processes that share its cases: to start a process takes longer than most cases.
# ALONE: further sources, whose helpers have names of others' ("redefinition of"): each compiled alone, the others eight
# together.
# SLOW_ORACLE: what the test itself computes takes too long without optimization, where tests are built so.
function(cairn_add_test name)
  cmake_parse_arguments(arg "SLOW_ORACLE" "SHARDS" "SOURCES;ALONE;LINK" ${ARGN})
  set_source_files_properties(${arg_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  list(APPEND arg_SOURCES ${arg_ALONE})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE GTest::gmock GTest::gtest_main cairn_private_options ${arg_LINK})
  target_compile_definitions(${name} PRIVATE CAIRN_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             CAIRN_BINARY_DIR="${CMAKE_BINARY_DIR}")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  cairn_test_options(${name})
  if(CAIRN_SANITIZERS AND arg_SLOW_ORACLE)
    target_compile_options(${name} PRIVATE -O1)
  else()
    target_precompile_headers(${name} REUSE_FROM cairn_test_headers)
  endif()
  # What stands in for a world or a host runs for long; what a case itself does is short.
  if(CAIRN_SANITIZERS)
    list(FILTER arg_SOURCES EXCLUDE REGEX "_test[.]cpp$")
    set_source_files_properties(${arg_SOURCES} PROPERTIES COMPILE_OPTIONS -O1 SKIP_PRECOMPILE_HEADERS ON)
  endif()
  if(arg_SHARDS)
    math(EXPR last "${arg_SHARDS} - 1")
    foreach(shard RANGE ${last})
      add_test(NAME ${name}.${shard} COMMAND ${name})
      list(APPEND tests ${name}.${shard})
      set_tests_properties(${name}.${shard} PROPERTIES TIMEOUT 1800
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endforeach()
  else()
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES TIMEOUT 1800)
    set(tests ${name})
  endif()
  add_dependencies(cairn_tests ${name})
  if(CAIRN_TEST_TIER)  # of the folder: tests/CMakeLists.txt
    set_tests_properties(${tests} PROPERTIES LABELS ${CAIRN_TEST_TIER})
    add_dependencies(cairn_${CAIRN_TEST_TIER}_tests ${name})
  endif()
endfunction()
