// Meshes in space: rigid motions have no strain on facets, curved cells, folds and branches, small or finite, and the two forms of
// the strains agree.
#include "assembly/sample_shells.hpp"
#include "domain/space_surface.hpp"

#include <plastron/assembly/deformed.hpp>
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

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

/// A plate with a rib of height one half, a fold at its side, and a plate across the ends of both.
topology::SpaceMesh rib_beside_a_fold(Shape shape) {
  topology::SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const double at : {0.0, 1.0}) add_grid({1, 1, 1}, plate(at * x, x, y), mesh);
  for (const double at : {0.0, 1.0, 2.0}) add_grid({1, 1, 1}, plate(at * x, 0.5 * z, y), mesh);
  for (const double at : {0.0, 1.0}) add_grid({1, 1, 1}, plate(at * x, x, 0.5 * z), mesh);
  return glued(std::move(mesh));
}

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
    all.push_back({"cross" + cells, star(shape, 1, 1, {0.3, 0.3 + pi / 2, 0.3 + pi, 0.3 + 3 * pi / 2}), 2});
    all.push_back({"star of five" + cells, star(shape, 1, 1, {0, 1, 2.4, pi, 5}), 2});
    all.push_back({"rib beside a fold" + cells, rib_beside_a_fold(shape), 2});
  }
  return all;
}

struct Shell {
  std::shared_ptr<const fem::Space> space;
  std::unique_ptr<DiscreteShell> discrete;
};

Shell shell_on(const topology::SpaceMesh& mesh, int degree, element::Formulation formulation,
               element::Rotations rotations = element::Rotations::small) {
  const fem::MeshSequence meshes(domain::surface_mesh(surface_of(mesh), mesh.shape), degree, MPI_COMM_WORLD,
                                 [](std::shared_ptr<const fem::Space> space) {
                                   const fem::Surface surface(space->coarse, {});
                                   return fem::joined(std::move(space), surface, {});
                                 });
  ShellDescription description{.tangency = {.formulation = formulation}, .rotations = rotations};
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
    const energy::ShellOperator& op = shell.discrete->shell;
    const algebra::Vector y = some_field(*shell.space);
    double by_cells = 0;
    for (std::size_t cell = 0; cell < shell.space->owned_cells; ++cell) {
      const energy::CellStrain strains = op.strains(cell, op.gather(cell, y));
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

/// Returns an increment from the state of the shell of random coordinates.
algebra::Vector some_increment(const DiscreteShell& discrete) {
  std::mt19937 random(11);
  algebra::Vector z(discrete.space().layout, discrete.coordinates.width), y(discrete.space().layout, 6);
  for (double& value : z.owned()) value = std::uniform_real_distribution<double>(-1, 1)(random);
  z.update_ghosts();
  discrete.coordinates.to_cartesian(z, y);
  return y;
}

/// Returns (u, r) of a rotation about the origin.
algebra::Vector turned_by(const Eigen::Vector3d& rotation, const DiscreteShell& discrete) {
  const Eigen::Matrix3d change =
      Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix() - Eigen::Matrix3d::Identity();
  return test::interpolant(discrete.shell, [&](const NodalPoint& p) {
    Vector6 y;
    y << change * p.phi, change * p.a3;
    return y;
  });
}

algebra::Vector sum(algebra::Vector y, double factor, const algebra::Vector& z) {
  algebra::axpy(factor, z, y);
  y.update_ghosts();
  return y;
}

std::vector<Part> parts_of_all_degrees() {
  std::vector<Part> all;
  for (const Part& part : parts())
    for (int degree = part.degree; degree <= (part.mesh.shape == Shape::triangle ? 2 : 4); ++degree)
      all.push_back({part.name + " at degree " + std::to_string(degree), part.mesh, degree});
  return all;
}

Shell finite_shell_on(const Part& part) {
  return shell_on(part.mesh, part.degree, element::Formulation::tangent, element::Rotations::finite);
}

// The directors of a mesh of order 2 or more are shorter than 1 at nodes that are not those of the file. Were they 1 in the state
// alone, a small motion would have an energy that does not vanish with it.
TEST(Directors, SmallMotionsHaveTheEnergyOfTheLinearModelWithFiniteRotations) {
  constexpr double size = 1e-7;
  for (const Part& part : parts_of_all_degrees()) {
    const Shell shell = finite_shell_on(part);
    const algebra::Vector y = some_increment(*shell.discrete);
    const double linear = shell.discrete->shell.energies(y).total();
    algebra::Vector small(y.layout(), 6);
    linearise(*shell.discrete, {.displacement = sum(std::move(small), size, y)});
    const double energy = shell.discrete->energies(shell.discrete->state.displacement).total();
    EXPECT_NEAR(energy / (size * size), linear, 1e-4 * linear) << part.name;
  }
}

TEST(Directors, RotationsByAnyAngleHaveNoStrainAndSatisfyTheFolds) {
  const Eigen::Vector3d rotation(0.5, 0.9, -0.6), c(0.3, -0.2, 0.5), w(0.1, 0.7, -0.4);
  for (const Part& part : parts_of_all_degrees()) {
    const Shell shell = finite_shell_on(part);
    DiscreteShell& discrete = *shell.discrete;
    const double strained = discrete.shell.energies(some_field(*shell.space)).total();
    const algebra::Vector turned = turned_by(rotation, discrete);
    linearise(discrete, {.displacement = turned});
    EXPECT_LT(algebra::max_abs(sum(turned, -1, discrete.state.displacement)), 1e-12) << part.name;
    EXPECT_LT(discrete.energies(discrete.state.displacement).total(), 1e-24 * strained) << part.name;
    const algebra::Vector rigid = test::rigid_motion(*shell.space, discrete.moved, c, w);
    EXPECT_LT(discrete.motion_energies(rigid).total(), 1e-20 * strained) << part.name;
    algebra::Vector constrained = rigid;
    discrete.coordinates.space->constraints.apply(constrained);
    EXPECT_LT(algebra::max_abs(sum(constrained, -1, rigid)), 1e-12) << part.name;
  }
}

// Newton steps converge if the state after an increment differs from it by terms of second order only.
TEST(Directors, IncrementsFromADeformedStateAreTangentsOfStates) {
  for (const Part& part : parts()) {
    const Shell shell = finite_shell_on(part);
    DiscreteShell& discrete = *shell.discrete;
    const algebra::Vector some = some_increment(discrete);
    linearise(discrete, {.displacement = sum(turned_by({0.4, -1, 0.5}, discrete), 0.1, some)});
    const algebra::Vector state = discrete.state.displacement, increment = some_increment(discrete);
    const auto departure = [&](double size) {
      const algebra::Vector moved = sum(state, size, increment);
      return algebra::max_abs(sum(with_kept_lengths(*shell.space, discrete.points, moved), -1, moved));
    };
    EXPECT_NEAR(departure(1e-4) / departure(1e-5), 100, 5) << part.name;
  }
}

}  // namespace
}  // namespace plastron::assembly
