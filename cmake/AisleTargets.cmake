# Warnings and sanitizers for our own code, in one INTERFACE target, and one function a kind of target.
find_package(Eigen3 REQUIRED NO_MODULE)

add_library(aisle_options INTERFACE)
target_compile_options(aisle_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
if(AISLE_WARNINGS_AS_ERRORS)
  target_compile_options(aisle_options INTERFACE -Werror)
endif()
if(AISLE_SANITIZE)
  add_compile_options(-fsanitize=${AISLE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${AISLE_SANITIZE})
endif()

# For files that compute with batches (common/geometry/batch.hpp). The first two let roots and comparisons become vector instructions:
# no code here reads errno or floating-point traps. The last forbids fused multiply-add, so that every machine rounds alike.
set(AISLE_BATCH_OPTIONS "-fno-math-errno;-fno-trapping-math;-ffp-contract=off")
if(AISLE_VECTORS)
  list(APPEND AISLE_BATCH_OPTIONS -DAISLE_VECTORS)
endif()

# aisle_library(NAME SOURCES a.cpp... LINKS lib...): a room of the tree; headers are included from the top, e.g. "common/grid/occupancy_grid.hpp".
function(aisle_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${ARG_LINKS} PRIVATE aisle_options ${ARG_PRIVATE_LINKS})
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${name} INTERFACE ${ARG_LINKS})
  endif()
endfunction()

# What only reads arguments, or only asks and compares: it is compiled more often than it runs.
set(AISLE_QUICK_TO_COMPILE $<$<CONFIG:Release>:-O1>)

# ccache keeps what is compiled with a precompiled header only if GCC names that header in the preprocessed text.
set(AISLE_PRECOMPILED $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)

# aisle_program(NAME SOURCES main.cpp LINKS lib...): a program in build/bin, part of the target `programs` unless it serves only the tests.
function(aisle_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE aisle_options ${ARG_LINKS})
  target_compile_options(${name} PRIVATE ${AISLE_QUICK_TO_COMPILE})
  string(FIND ${CMAKE_CURRENT_SOURCE_DIR}/ ${CMAKE_SOURCE_DIR}/tests/ in_tests)
  if(in_tests EQUAL -1)
    add_dependencies(programs ${name})
  endif()
endfunction()

# aisle_test_program(NAME SOURCES a_test.cpp... LINKS lib...): a GoogleTest program in build/tests that ctest does not know yet.
function(aisle_test_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE aisle_options aisle_test_places GTest::gmock_main ${ARG_LINKS})
  target_compile_options(${name} PRIVATE ${AISLE_QUICK_TO_COMPILE})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(AISLE_PRECOMPILE)
    target_precompile_headers(${name} REUSE_FROM aisle_test_places)
    target_compile_options(${name} PRIVATE ${AISLE_PRECOMPILED})
  endif()
endfunction()

# aisle_test(NAME SOURCES a_test.cpp... LINKS lib... [LABEL unit]): a GoogleTest program that is one ctest entry.
function(aisle_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LINKS" ${ARGN})
  aisle_test_program(${name} SOURCES ${ARG_SOURCES} LINKS ${ARG_LINKS})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT 600)
  if(TARGET ${ARG_LABEL}_tests)
    add_dependencies(${ARG_LABEL}_tests ${name})
  endif()
  if(name MATCHES "^(bus|simulated_network)_")
    add_dependencies(bus_tests ${name})
  endif()
endfunction()

# aisle_without_unity(DIRECTORY): each source of the targets below is compiled alone.
function(aisle_without_unity directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    set_property(TARGET ${target} PROPERTY UNITY_BUILD OFF)
  endforeach()
  get_property(folders DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(folder IN LISTS folders)
    aisle_without_unity(${folder})
  endforeach()
endfunction()
