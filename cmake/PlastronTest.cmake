# plastron_test(NAME SOURCES ... DEPENDS plastron folders EXTERNAL targets LABEL quick|verification|slow RANKS 1 2 ... QUICK_RANKS 1|2 ON_RANKS names
#               SLOW_RANKS 2|3 SANITIZED_RANKS 0|1|2 SEPARATE files that are compiled by themselves OBJECTS libraries of plastron_test_objects)
#
# A test of CTest: the tests of some files, of GoogleTest. With RANKS it runs under mpirun once for every count, and the count is in its name.
# The runs on up to QUICK_RANKS ranks (2) of a quick test are quick, those on more are verification: on two cores they take many times as long.
# The runs of a verification test on SLOW_RANKS ranks (3) and more have the label slow. With ON_RANKS a:b:c the tests of these names (a filter of
# GoogleTest) run on several ranks, and all of them there with the label slow: what one rank computes as well is not looked for again.
# With the sanitizers, which show what each process does with its memory, one rank is enough, but up to SANITIZED_RANKS for code that exchanges data.
# With SANITIZED_RANKS 0 a test is not part of the sanitized build: it takes a minute there, and other tests run the same code.
# Tests of FOLDER_long_test have the COST 1: they start first, and short tests fill both cores at the end.
#
# All quick tests of a folder FOLDER are one program, FOLDER_test, all others FOLDER_long_test (tests/test_main.cc has the choice of files): half of
# the compiler's time for one file goes into what all files of a folder include, and a batch of files spares it.
include(GoogleTest)
find_package(GTest REQUIRED)

# Test programs spend their time in the libraries: their own files need little optimisation, and compile a fifth faster without.
set(test_options -O1)
plastron_precompiled(plastron_precompiled_tests OPTIONS ${test_options} EXTERNAL GTest::gtest GTest::gmock
                     HEADERS ${standard_headers} ${external_headers} <gmock/gmock.h> <gtest/gtest.h>)
# Names of one file may be those of another file of its batch.
add_library(plastron_test_names INTERFACE)
target_compile_options(plastron_test_names INTERFACE -Wno-shadow)
# All programs that quick tests run, and those that any test runs.
add_custom_target(quick_tests)
add_custom_target(all_tests)
add_dependencies(all_tests quick_tests plastron plastron-study plastron_generated)

# Sets `environment` and `session` of the test program `name`.
macro(plastron_mpi_environment name)
  set(environment OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
      OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
  # Open MPI removes its session directory when it ends, even while another process is just making its own in it.
  set(session ${PROJECT_BINARY_DIR}/mpi/${name})
  file(MAKE_DIRECTORY ${session})
  list(APPEND environment OMPI_MCA_orte_tmpdir_base=${session})
endmacro()

# plastron_run_test(NAME program ranks arguments...): a quick test that is a run of a program which is no GoogleTest's, judged by its exit
# code. Anything on standard output or standard error is a failure: the library prints nothing.
function(plastron_run_test test program ranks)
  string(REPLACE ";" "." test "${test}")
  plastron_mpi_environment(${program})
  add_test(NAME ${test}.ranks=${ranks}
           COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${program}> ${ARGN})
  set_tests_properties(${test}.ranks=${ranks} PROPERTIES LABELS quick TIMEOUT 60 PROCESSORS ${ranks} ENVIRONMENT "${environment}"
                       RESOURCE_LOCK ${session} FAIL_REGULAR_EXPRESSION ".")
endfunction()

# Compiles a target's files as those of tests.
function(plastron_as_test target)
  target_link_libraries(${target} PRIVATE plastron_warnings plastron_test_names plastron_test_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE PLASTRON_TESTS_DIR="${PROJECT_SOURCE_DIR}/tests" PLASTRON_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                             PLASTRON_BUILD_VERSION="${PROJECT_VERSION}")
  target_compile_options(${target} PRIVATE ${test_options})
  plastron_use_precompiled(${target} plastron_precompiled_tests)
endfunction()

# plastron_test_objects(NAME SOURCES ... DEPENDS plastron folders EXTERNAL targets): tests that several programs run, compiled once.
function(plastron_test_objects name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;EXTERNAL" ${ARGN})
  add_library(${name} OBJECT ${ARG_SOURCES})
  plastron_as_test(${name})
  list(TRANSFORM ARG_DEPENDS PREPEND plastron_)
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} ${ARG_EXTERNAL})
  plastron_unity(${name})
endfunction()

# Adds files and libraries to the program of a folder's tests.
function(plastron_test_program program)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;EXTERNAL;SEPARATE;OBJECTS" ${ARGN})
  if(NOT TARGET ${program})
    add_executable(${program})
    plastron_as_test(${program})
    add_dependencies(all_tests ${program})
  endif()
  foreach(objects IN LISTS ARG_OBJECTS)
    target_sources(${program} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
  get_target_property(known ${program} SOURCES)
  foreach(source IN LISTS ARG_SOURCES)
    if(NOT source IN_LIST known)
      target_sources(${program} PRIVATE ${source})
    endif()
  endforeach()
  plastron_unity(${program} SEPARATE ${ARG_SEPARATE})
  foreach(dependency IN LISTS ARG_DEPENDS)
    target_link_libraries(${program} PRIVATE plastron_${dependency})
  endforeach()
  target_link_libraries(${program} PRIVATE ${ARG_EXTERNAL})
endfunction()

# Sets what a run of plastron_test() on `ranks` ranks needs.
macro(plastron_run_on_ranks run label)
  set_tests_properties(${run} PROPERTIES LABELS ${label} COST ${cost} TIMEOUT ${ARG_TIMEOUT} PROCESSORS ${ranks} ENVIRONMENT "${environment}"
                       RESOURCE_LOCK ${session})
endmacro()

function(plastron_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT;QUICK_RANKS;SLOW_RANKS;SANITIZED_RANKS;ON_RANKS" "SOURCES;DEPENDS;EXTERNAL;RANKS;SEPARATE;OBJECTS" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL quick)
  endif()
  if(NOT ARG_QUICK_RANKS)
    set(ARG_QUICK_RANKS 2)
  endif()
  if(NOT ARG_SLOW_RANKS)
    set(ARG_SLOW_RANKS 3)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  if("${ARG_SANITIZED_RANKS}" STREQUAL "")
    set(ARG_SANITIZED_RANKS 1)
  endif()
  if(PLASTRON_SANITIZE AND ARG_SANITIZED_RANKS EQUAL 0)
    return()
  endif()
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  if(ARG_LABEL STREQUAL quick)
    set(program ${folder}_test)
    set(cost 0)
    add_dependencies(quick_tests ${program})
  else()
    set(program ${folder}_long_test)
    set(cost 1)
  endif()
  plastron_test_program(${program} SOURCES ${ARG_SOURCES} DEPENDS ${ARG_DEPENDS} EXTERNAL ${ARG_EXTERNAL} SEPARATE ${ARG_SEPARATE}
                        OBJECTS ${ARG_OBJECTS})
  foreach(objects IN LISTS ARG_OBJECTS)
    get_target_property(sources ${objects} SOURCES)
    list(APPEND ARG_SOURCES ${sources})
  endforeach()
  list(JOIN ARG_SOURCES "," files)
  plastron_mpi_environment(${name})
  if(NOT ARG_RANKS)
    add_test(NAME ${name} COMMAND ${program} --files=${files})
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} COST ${cost} TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "${environment}")
  endif()
  foreach(ranks IN LISTS ARG_RANKS)
    if(PLASTRON_SANITIZE AND ranks GREATER ARG_SANITIZED_RANKS)
      continue()
    endif()
    set(label ${ARG_LABEL})
    if(ranks GREATER_EQUAL ARG_SLOW_RANKS AND (ARG_SLOW_RANKS LESS 3 OR NOT label STREQUAL quick))
      set(label slow)
    elseif(ranks GREATER ARG_QUICK_RANKS)
      set(label verification)
    endif()
    set(run ${name}.ranks=${ranks})
    set(launch COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${program}>)
    if(ARG_ON_RANKS AND ranks GREATER 1)
      add_test(NAME ${run} ${launch} --gtest_filter=${ARG_ON_RANKS})
      plastron_run_on_ranks(${run} ${label})
      set(run ${run}.all)
      set(label slow)
    endif()
    add_test(NAME ${run} ${launch} --files=${files})
    plastron_run_on_ranks(${run} ${label})
  endforeach()
endfunction()
