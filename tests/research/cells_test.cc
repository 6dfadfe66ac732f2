// Every study and the comparison take the cells, the degree and the formulation that the case names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <research/study/kinds.hpp>

#include <algorithm>
#include <cmath>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

using element::Formulation;
using mesh::Shape;

struct Element {
  Shape cells;
  int degree;
};

/// A small shell above a table, clamped at two sides and pressed on it.
Problem small_panel(const Element& element) {
  Problem p = with_chart(free_plate(), {"x", "y", "0.06 + 0.2*x^2"});
  p.shell.supports = {clamped("left"), clamped("right")};
  p.shell.loads.on_areas = {force(0, 0, -100)};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  p.domain = domain::Rectangle{.cells = {2, 2}};
  p.discretisation = {.cells = element.cells, .degree = element.degree, .refinements = 1};
  return p;
}

std::vector<const Kind*> all_kinds() {
  std::vector<const Kind*> all{&comparison()};
  for (const Kind& kind : kinds()) all.push_back(&kind);
  return all;
}

void expect_computed(const Kind& kind, Problem problem) {
  SCOPED_TRACE(kind.name);
  // The default accuracy is too high for elements of degree 1.
  if (kind.name == "adaptivity") problem.accuracy = problem::Accuracy{.goals = {{"energy", 0.1}}, .max_unknowns = 3000};
  ASSERT_FALSE(examination::has_errors(study::examine(kind, problem, few_samples(1))));
  const Report report = kind.run(problem, few_samples(1), MPI_COMM_SELF, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  EXPECT_FALSE(report.table.rows.empty());
  EXPECT_FALSE(report.table.claims.empty());
}

TEST(EveryStudy, TakesTheCellsAndTheDegreeOfTheCase) {
  for (const Element& element :
       {Element{Shape::triangle, 1}, Element{Shape::triangle, 2}, Element{Shape::quadrilateral, 1}})
    for (const Kind* kind : all_kinds()) expect_computed(*kind, small_panel(element));
}

TEST(EveryStudy, TakesTheFormulationOfTheCase) {
  for (const Formulation formulation : {Formulation::penalised, Formulation::mixed, Formulation::classical})
    for (const Shape cells : {Shape::triangle, Shape::quadrilateral}) {
      Problem p = small_panel({cells, 2});
      p.shell.tangency.formulation = formulation;
      p.discretisation.refinements = 0;
      for (const Kind* kind : all_kinds()) expect_computed(*kind, p);
    }
}

TEST(EveryStudy, TakesAMeshFile) {
  for (const Shape cells : {Shape::triangle, Shape::quadrilateral}) {
    Problem p = small_panel({cells, 2});
    p.domain = domain::MeshFile{PLASTRON_TESTS_DIR "/verification/meshes/distorted-square.msh"};
    p.charts.emplace("square", p.charts.at(""));
    p.charts.erase("");
    p.discretisation.refinements = 0;
    for (const Kind* kind : all_kinds()) expect_computed(*kind, p);
  }
}

/// Nodes of a uniformly refined rectangle of 2 x 2 coarse cells.
std::int64_t nodes(const Element& element, int level) {
  const std::int64_t n = static_cast<std::int64_t>(2 * element.degree) << level;
  return element.cells == Shape::quadrilateral ? (n + 1) * (n + 1) : (n + 1) * (n + 1) + n * n;
}

// Triangles are quadrilaterals cut crosswise, with a node in the middle of each.
TEST(Stability, IsThatOfTheCellsOfTheCase) {
  for (const Element& element : {Element{Shape::triangle, 1}, Element{Shape::quadrilateral, 1}}) {
    const Report report = find_kind("stability")->run(small_panel(element), few_samples(1), MPI_COMM_SELF, {});
    for (std::int64_t row = 0; row < 4; ++row)
      EXPECT_EQ(std::get<std::int64_t>(report.table.rows[static_cast<std::size_t>(row)][4]),
                nodes(element, static_cast<int>(row % 2)));
  }
}

TEST(SoftModesStudy, IsThatOfTheCellsOfTheCase) {
  std::vector<double> sizes;
  for (const Shape cells : {Shape::triangle, Shape::quadrilateral}) {
    const Report report = find_kind("soft-modes")->run(small_panel({cells, 1}), few_samples(1), MPI_COMM_SELF, {});
    sizes.push_back(numbers(report.table, "mesh").front());
  }
  EXPECT_NEAR(sizes[1] / sizes[0], 2, 1e-2);  // four triangles to a quadrilateral
}

TEST(SoftModesStudy, LeavesTheClassicalFormulationOutWhereCurvatureJumps) {
  Problem p = small_panel({Shape::quadrilateral, 2});
  p.domain = domain::Rectangle{.to = {2, 1}, .cells = {2, 1}, .breaks = {1}, .regions = {"flat", "round"}};
  p.charts.clear();
  p.charts.emplace("flat", Chart({"x", "y", "0.06"}, {}));
  p.charts.emplace("round", Chart({"1 + sin(x - 1)", "y", "1.06 - cos(x - 1)"}, {}));
  const Report report = find_kind("soft-modes")->run(p, few_samples(1), MPI_COMM_SELF, {});
  EXPECT_THAT(report.table.remarks, testing::Contains(testing::HasSubstr("classical left out")));
  for (const auto& row : report.table.rows) EXPECT_NE(std::get<std::string>(row.front()), "classical");
}

}  // namespace
}  // namespace plastron::study
