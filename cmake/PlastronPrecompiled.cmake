# Precompiled headers: a third of the time of a file of ours goes into headers of others that never change.
#
# plastron_precompiled(NAME HEADERS ... OPTIONS ... EXTERNAL ...) compiles them once; plastron_use_precompiled(target NAME) includes them first
# in every file of a target. No more of them than most files need: what they leave to instantiate is done again in each. Headers of Plastron
# are never among them, or the folder graph would not be enforced any more. Files still name all headers they need: clang-tidy reads them
# without (scripts/check-tidy). With -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON nothing of this happens.
function(plastron_precompiled name)
  cmake_parse_arguments(ARG "" "" "HEADERS;OPTIONS;EXTERNAL" ${ARGN})
  set(source ${PROJECT_BINARY_DIR}/precompiled/${name}.cc)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE plastron_warnings Eigen3::Eigen fmt::fmt MPI::MPI_CXX)
  target_link_libraries(${name} PRIVATE ${ARG_EXTERNAL})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

function(plastron_use_precompiled target name)
  target_link_libraries(${target} PRIVATE fmt::fmt)  # its definitions are those the headers were compiled with
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

set(standard_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numeric> <optional> <set>
    <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>)
set(external_headers <mpi.h> <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU> <fmt/format.h> <fmt/ranges.h>)

# For folders that compute with fields, and for those that read and write files, too.
plastron_precompiled(plastron_precompiled_fields HEADERS ${standard_headers} ${external_headers})
# The latter are compiled with little optimisation: they are a third of a build and no time of a run (a quarter less of their compile time).
set(plastron_edge_options -O1)
plastron_precompiled(plastron_precompiled_edge OPTIONS ${plastron_edge_options} EXTERNAL nlohmann_json::nlohmann_json
                     HEADERS ${standard_headers} ${external_headers} <nlohmann/json.hpp>)
