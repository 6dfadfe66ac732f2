# Installs the build, builds a program outside of Plastron's sources with it, and compares its number with the installed program's:
#   cmake -D BUILD=... -D SOURCES=... -D SCRATCH=... -D COMPILER=... -D GENERATOR=... -P installed.cmake
cmake_minimum_required(VERSION 3.25)

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${what} failed (${code}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
set(prefix ${SCRATCH}/prefix)
run("installing" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

# The page shows the program that is built here.
file(READ ${SOURCES}/docs/library.md page)
foreach(shown CMakeLists.txt pressed_plate.cc)
  file(READ ${SOURCES}/tests/install/outside/${shown} text)
  string(FIND "${page}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "docs/library.md does not show tests/install/outside/${shown} as it is")
  endif()
endforeach()

# The package hands no build settings of Plastron on.
file(GLOB_RECURSE exported ${prefix}/*/cmake/Plastron/PlastronTargets*.cmake)
if(NOT exported)
  message(FATAL_ERROR "no targets were exported")
endif()
foreach(file IN LISTS exported)
  file(READ ${file} text)
  foreach(own -Werror plastron_warnings precompiled cmake_pch ${BUILD} ${SOURCES})
    string(FIND "${text}" "${own}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file} mentions ${own}")
    endif()
  endforeach()
endforeach()
foreach(header matrix_storage petsc_check)
  if(EXISTS ${prefix}/include/plastron/algebra/${header}.hpp)
    message(FATAL_ERROR "${header}.hpp is private, and was installed")
  endif()
endforeach()

foreach(file share/man/man1/plastron.1 share/bash-completion/completions/plastron share/zsh/site-functions/_plastron
             share/fish/vendor_completions.d/plastron.fish)
  file(READ ${prefix}/${file} text)
  if(NOT text MATCHES "verify")
    message(FATAL_ERROR "${file} does not tell of the command verify")
  endif()
endforeach()

run("configuring" ${CMAKE_COMMAND} -S ${SOURCES}/tests/install/outside -B ${SCRATCH}/build -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${COMPILER})
run("building" ${CMAKE_COMMAND} --build ${SCRATCH}/build)
run("the outside program" ${SCRATCH}/build/pressed_plate)
if(NOT output MATCHES "^solved, the table carries ([-+.e0-9]+) N\n$")
  message(FATAL_ERROR "the outside program printed: ${output}")
endif()
set(outside ${CMAKE_MATCH_1})

run("the installed program" ${prefix}/bin/plastron run ${SOURCES}/tests/install/pressed_plate.toml --quiet --output ${SCRATCH}/out)
file(READ ${SCRATCH}/out/results.json results)
string(JSON inside GET "${results}" reaction force 2)
run("comparing ${outside} N of the outside program with ${inside} N of plastron"
    awk -v a=${outside} -v b=${inside} "BEGIN { exit !(a > 0 && (a - b)^2 <= (1e-12 * a)^2) }")

# The solver may lie in libexec instead of beside the program.
file(MAKE_DIRECTORY ${prefix}/libexec/plastron)
file(RENAME ${prefix}/bin/plastron-solver ${prefix}/libexec/plastron/plastron-solver)
file(RENAME ${prefix}/bin/plastron-study ${prefix}/libexec/plastron/plastron-study)
run("the program with its solver in libexec" ${prefix}/bin/plastron check ${SOURCES}/tests/install/pressed_plate.toml)
run("a study with its program in libexec" ${prefix}/bin/plastron study soft-modes ${SOURCES}/tests/install/pressed_plate.toml --quiet
    --output ${SCRATCH}/study)

# Studies may not be built yet.
file(REMOVE ${prefix}/libexec/plastron/plastron-study)
execute_process(COMMAND ${prefix}/bin/plastron study soft-modes ${SOURCES}/tests/install/pressed_plate.toml --output ${SCRATCH}/study
                RESULT_VARIABLE code ERROR_VARIABLE errors)
if(NOT code EQUAL 4 OR NOT errors MATCHES "plastron-study cannot be started: .*cmake --build")
  message(FATAL_ERROR "without plastron-study: exit code ${code}, ${errors}")
endif()
