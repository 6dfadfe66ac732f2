# Every third-party library, found once. All come from Debian 12's packages (scripts/install-dependencies).
find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(muparser REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(toml11 3.7 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(BLAS REQUIRED)
pkg_check_modules(GINAC REQUIRED IMPORTED_TARGET ginac)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
pkg_check_modules(SLEPC REQUIRED IMPORTED_TARGET slepc)
find_library(GMSH_LIBRARY gmsh REQUIRED)
find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_package(deal.II 9.4 REQUIRED)

include(${DEAL_II_TARGET_CONFIG})
# deal.II's exported targets carry the libraries but neither the include paths nor the definitions. Its release library serves the debug
# preset too: what the sanitizers look at is ours.
add_library(plastron_dealii INTERFACE)
target_include_directories(plastron_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_link_libraries(plastron_dealii INTERFACE ${DEAL_II_TARGET_RELEASE} MPI::MPI_CXX)
target_compile_options(plastron_dealii INTERFACE -fopenmp-simd)

add_library(plastron_gmsh INTERFACE)
target_include_directories(plastron_gmsh SYSTEM INTERFACE ${GMSH_INCLUDE_DIR})
target_link_libraries(plastron_gmsh INTERFACE ${GMSH_LIBRARY})
