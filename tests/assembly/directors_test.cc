// Meshes in space: rigid motions have no strain on facets, curved cells, folds and branches, and the two forms of the
// strains agree.
#include "assembly/sample_shells.hpp"
#include "domain/space_surface.hpp"

#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <gtest/gtest.h>

#include <random>

namespace plastron::assembly {
namespace {

using mesh::Shape;
using namespace topology::space_meshes;  // NOLINT: builders of meshes
using namespace domain::space_meshes;    // NOLINT: builders of meshes

struct Part {
  std::string name;
  topology::SpaceMesh mesh;
  int degree;
};

std::vector<Part> parts() {
  std::vector<Part> all;
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle}) {
    const std::string cells = shape == Shape::triangle ? ", triangles" : "";
    const int most = shape == Shape::triangle ? 2 : 4;
    for (int order = 1; order <= most; ++order) {
      all.push_back({"sphere of order " + std::to_string(order) + cells, sphere(shape, 2, order), order});
      all.push_back({"tube of order " + std::to_string(order) + cells, tube(shape, {5, 2, order}), most});
    }
    all.push_back({"facets at degree 2" + cells, sphere(shape, 3, 1), 2});
    all.push_back({"cube" + cells, cube(shape, 2), 2});
    all.push_back({"three plates" + cells, star(shape, 2, 1, {0, 2, 4}), 2});
    all.push_back({"rib" + cells, star(shape, 1, 2, {0, std::numbers::pi, 1.3}), 2});
  }
  return all;
}

struct Shell {
  std::shared_ptr<const fem::Space> space;
  std::unique_ptr<DiscreteShell> discrete;
};

Shell shell_on(const topology::SpaceMesh& mesh, int degree, element::Formulation formulation, bool tying = true) {
  const fem::MeshSequence meshes(domain::surface_mesh(surface_of(mesh), mesh.shape), degree, MPI_COMM_WORLD,
                                 [](std::shared_ptr<const fem::Space> space) {
                                   const fem::Surface surface(space->coarse, {});
                                   return fem::joined(std::move(space), surface, {});
                                 });
  ShellDescription description{.tying = tying, .tangency = {.formulation = formulation}};
  description.sections.common.thickness = geometry::Expression(0.01);
  description.sections.common.material = test::steel_like();
  auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, std::map<std::string, geometry::Chart>{});
  return {meshes.space(), discretise(meshes.space(), std::move(surface), description)};
}

algebra::Vector some_field(const fem::Space& space) {
  std::mt19937 random(7);
  algebra::Vector y(space.layout, 6);
  for (double& value : y.owned()) value = std::uniform_real_distribution<double>(-1, 1)(random);
  y.update_ghosts();
  return y;
}

double work(const DiscreteShell& discrete, const algebra::Vector& y) {
  algebra::Vector f(y.layout(), 6);
  discrete.apply(y, f);
  return algebra::dot(y, f);
}

TEST(Directors, RigidMotionsHaveNoStrainAndSatisfyTheFolds) {
  const geometry::Vector3d c(0.3, -0.2, 0.5), w(0.1, 0.7, -0.4);
  for (const Part& part : parts())
    for (const auto formulation : {element::Formulation::tangent, element::Formulation::penalised}) {
      const Shell shell = shell_on(part.mesh, part.degree, formulation);
      const algebra::Vector rigid = test::rigid_motion(*shell.space, shell.discrete->points, c, w);
      EXPECT_LT(work(*shell.discrete, rigid), 1e-20 * work(*shell.discrete, some_field(*shell.space))) << part.name;
      algebra::Vector constrained = rigid;
      shell.space->constraints.apply(constrained);
      algebra::axpy(-1, rigid, constrained);
      EXPECT_LT(algebra::max_abs(constrained), 1e-12) << part.name;
    }
}

TEST(Directors, StrainsByCellsAndByPacksHaveOneWork) {
  for (const Part& part : parts()) {
    const Shell shell = shell_on(part.mesh, part.degree, element::Formulation::tangent);
    const ShellOperator& op = shell.discrete->shell;
    const algebra::Vector y = some_field(*shell.space);
    double by_cells = 0;
    for (std::size_t cell = 0; cell < shell.space->owned_cells; ++cell) {
      const CellStrain strains = op.strains(cell, op.gather(cell, y));
      by_cells += strains.cwiseProduct(op.weighted_stresses(cell, strains)).sum();
    }
    by_cells = algebra::sum_over_ranks(by_cells, MPI_COMM_WORLD);
    EXPECT_NEAR(by_cells, work(*shell.discrete, y), 1e-12 * by_cells) << part.name;
  }
}

TEST(Directors, TheFrameHasTheCurvatureOfTheSphere) {
  const Shell shell = shell_on(sphere(Shape::quadrilateral, 4, 4), 4, element::Formulation::tangent);
  for (std::size_t cell = 0; cell < shell.space->owned_cells; ++cell)
    for (int q = 0; q < 16; ++q) {
      const auto kappa = geometry::principal_curvatures(shell.discrete->shell.point(cell, q).frame);
      EXPECT_NEAR(kappa[0], -1, 2e-3);  // a_3 points outwards
      EXPECT_NEAR(kappa[1], -1, 2e-3);
    }
}

}  // namespace
}  // namespace plastron::assembly
