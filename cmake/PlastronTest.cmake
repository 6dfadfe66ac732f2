# plastron_test(NAME SOURCES ... DEPENDS plastron folders EXTERNAL targets LABEL quick|verification|slow RANKS 1 2 ... QUICK_RANKS 1|2
#               SEPARATE files that are compiled by themselves)
#
# A GoogleTest program. With RANKS it is run once under mpirun for every count, and the count is in the test's name. Of a quick program
# the runs on up to QUICK_RANKS ranks (2) are quick, those on more are verification: on two cores they take many times as long. With the
# sanitizers two ranks are the most: three take minutes.
include(GoogleTest)
find_package(GTest REQUIRED)

# Test programs spend their time in the libraries: their own files need little optimisation, and compile a fifth faster without.
set(test_options -O1)
plastron_precompiled(plastron_precompiled_tests OPTIONS ${test_options} EXTERNAL GTest::gtest GTest::gmock
                     HEADERS ${standard_headers} ${external_headers} <gmock/gmock.h> <gtest/gtest.h>)
# All programs that quick tests run.
add_custom_target(quick_tests)

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

function(plastron_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT;QUICK_RANKS" "SOURCES;DEPENDS;EXTERNAL;RANKS;SEPARATE" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL quick)
  endif()
  if(NOT ARG_QUICK_RANKS)
    set(ARG_QUICK_RANKS 2)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE plastron_warnings plastron_test_main)
  foreach(dependency IN LISTS ARG_DEPENDS)
    target_link_libraries(${name} PRIVATE plastron_${dependency})
  endforeach()
  target_link_libraries(${name} PRIVATE ${ARG_EXTERNAL})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  plastron_unity(${name} SEPARATE ${ARG_SEPARATE})
  target_compile_options(${name} PRIVATE ${test_options})
  plastron_use_precompiled(${name} plastron_precompiled_tests)
  if(ARG_LABEL STREQUAL quick)
    add_dependencies(quick_tests ${name})
  endif()
  plastron_mpi_environment(${name})
  if(NOT ARG_RANKS)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "${environment}")
  endif()
  if(PLASTRON_SANITIZE)
    list(REMOVE_ITEM ARG_RANKS 3)
  endif()
  foreach(ranks IN LISTS ARG_RANKS)
    set(label ${ARG_LABEL})
    if(ranks GREATER ARG_QUICK_RANKS)
      set(label verification)
    endif()
    add_test(NAME ${name}.ranks=${ranks} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${name}>)
    set_tests_properties(${name}.ranks=${ranks} PROPERTIES LABELS ${label} TIMEOUT ${ARG_TIMEOUT}
                         PROCESSORS ${ranks} ENVIRONMENT "${environment}" RESOURCE_LOCK ${session})
  endforeach()
endfunction()
