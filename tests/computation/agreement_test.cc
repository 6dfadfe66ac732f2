// An error on one rank alone ends the computation on all ranks, with the same message. If it does not, the test hangs.
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/energy/load_vector.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace plastron::test {
namespace {

using problem::Problem;

bool is_last() {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return rank == ranks - 1;
}

Problem plate() {
  Problem problem;
  problem.charts.emplace("", geometry::Chart({"x", "y", "0"}, {}));
  problem.shell.sections.common.thickness = geometry::Expression(0.1);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  assembly::Support clamped{.boundary = "left", .components = {}};
  using assembly::Direction, assembly::Unknown;
  for (const auto unknown : {Unknown::displacement, Unknown::rotation})
    for (const auto direction : {Direction::x, Direction::y, Direction::z})
      clamped.components.push_back({unknown, direction, {}});
  problem.shell.supports = {clamped};
  problem.discretisation = {.degree = 1, .refinements = 1};
  return problem;
}

template <class Error>
void expect_error(const Problem& problem, const std::string& words) {
  try {
    computation::solve(problem, MPI_COMM_WORLD);
    ADD_FAILURE() << "no error on this rank";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(words));
  }
}

TEST(MeshFile, ThatOneRankCannotReadIsAnErrorOfAll) {
  Problem problem = plate();
  const std::string file = PLASTRON_TESTS_DIR "/domain/data/quarter-annulus-2.2.msh";
  problem.domain = domain::MeshFile{is_last() ? "/no/such.msh" : file};
  expect_error<mesh::DomainError>(problem, "/no/such.msh");
}

TEST(MeshFile, ThatIsAnotherOneOnOneRankIsAnErrorOfAll) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) GTEST_SKIP() << "there is no other rank";
  Problem problem = plate();
  const std::string folder = PLASTRON_TESTS_DIR "/domain/data";
  problem.domain = domain::MeshFile{folder + (is_last() ? "/quarter-annulus-2.2.msh" : "/two-regions-4.1.msh")};
  expect_error<mesh::DomainError>(problem, "different meshes");
}

TEST(Load, ThatThrowsInOneCellIsAnErrorOfAllRanks) {
  Problem problem = plate();
  problem.shell.loads.on_areas.emplace_back().force_function = [](double x, double y) -> Eigen::Vector3d {
    if (x > 0.8 && y > 0.8) throw std::out_of_range("the table of winds ends here");
    return {0, 0, -1e-6};
  };
  expect_error<std::out_of_range>(problem, "the table of winds ends here");
}

TEST(Load, ThatIsInfiniteInOneCellIsAnErrorOfAllRanksThatNamesThePlace) {
  Problem problem = plate();
  problem.shell.loads.on_areas.emplace_back().force[2] =
      geometry::Expression("x > 0.8 ? (y > 0.8 ? 1e300^2 : 0) : 0", geometry::Constants{});
  expect_error<energy::LoadError>(problem, "near x = 0.8");
}

TEST(Support, ThatContradictsAnotherAtOneNodeIsAnErrorOfAllRanks) {
  Problem problem = plate();
  problem.shell.supports.push_back(
      {.boundary = "top",
       .components = {{assembly::Unknown::displacement, assembly::Direction::z, geometry::Expression(0.01)}}});
  expect_error<assembly::SupportError>(problem, "");
}

}  // namespace
}  // namespace plastron::test
