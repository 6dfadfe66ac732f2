// Fields of a fine mesh: their nodal values on a coarse mesh, and the nearest field of its K by nodal coordinates.
#include <gtest/gtest.h>
#include <plastron/geometry/frame.hpp>
#include <plastron/meshing/sequence.hpp>
#include <research/study/falk.hpp>
#include <research/study/nested_meshes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "computation/problems.hpp"
#include "supported.hpp"

namespace plastron::study {
namespace {

using namespace test;

/// A shell on a mesh, and on the mesh that divides each of its cells in four.
struct TwoMeshes {
  explicit TwoMeshes(const Problem& problem) : sequence(meshing::mesh_sequence(problem, MPI_COMM_WORLD)) {
    coarse = discretised(problem);
    field = algebra::Vector(coarse->space().layout, 6);
    for (std::size_t i = 0; i < coarse->points.size(); ++i) {
      const Eigen::Vector2d& x = coarse->points[i].x;
      for (std::size_t k = 0; k < 6; ++k)
        field.local()[6 * i + k] = -0.3 * std::sin(3 * x[0] + static_cast<double>(k)) * std::cos(5 * x[1]);
    }
    std::array carried{field};
    sequence.refine(carried);
    fine_field = std::move(carried[0]);
    fine_field.update_ghosts();
    fine = discretised(problem);
  }
  std::unique_ptr<assembly::DiscreteShell> discretised(const Problem& problem) const {
    return assembly::discretise(sequence.space(),
                                std::make_shared<const fem::Surface>(sequence.space()->coarse, problem.charts),
                                problem.shell);
  }

  fem::MeshSequence sequence;
  std::unique_ptr<assembly::DiscreteShell> coarse{}, fine{};
  algebra::Vector field{}, fine_field{};
};

double largest_difference(const algebra::Vector& a, const algebra::Vector& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.local().size(); ++i) most = std::max(most, std::abs(a.local()[i] - b.local()[i]));
  return most;
}

TEST(ValuesAtNodes, bring_back_a_field_that_was_carried_to_a_finer_mesh) {
  for (const int degree : {1, 2, 3, 5})  // nodes of degree 3 and more are no nodes of the finer mesh
    for (const auto shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
      if (shape == mesh::Shape::triangle && degree > 2) continue;
      Problem p = pressed_bowl();
      p.discretisation = {.cells = shape, .degree = degree};
      const TwoMeshes meshes(p);
      EXPECT_LT(largest_difference(values_at_nodes(meshes.coarse->space(), meshes.fine->shell, meshes.fine_field),
                                   meshes.field),
                1e-13)
          << degree;
    }
}

TEST(NearestAdmissible, is_in_the_discrete_cone_and_leaves_what_is_in_it) {
  Problem p = pressed_bowl();
  p.discretisation.degree = 3;
  const TwoMeshes meshes(p);
  const assembly::DiscreteShell& discrete = *meshes.coarse;
  const algebra::Vector y = nearest_admissible(discrete, meshes.field);
  int closed = 0;
  for (std::size_t i = 0; i < discrete.points.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> u(y.local().data() + 6 * i), r(y.local().data() + 6 * i + 3);
    EXPECT_NEAR(r.dot(discrete.points[i].a3), 0, 1e-14);
    const double gap = discrete.coordinates.gaps[0][i](u, r);
    EXPECT_GE(gap, -1e-14);
    closed += gap < 1e-14;
    if (!test::is_supported(discrete.coordinates, i)) continue;
    EXPECT_NEAR(u.norm() + r.norm(), 0, 1e-14);
  }
  EXPECT_GT(closed, 0);  // the field does penetrate the table
  EXPECT_LT(largest_difference(nearest_admissible(discrete, y), y), 1e-14);
}

TEST(VirtualPart, is_zero_at_supports_and_tangent_and_knows_no_obstacle) {
  Problem p = pressed_bowl();
  const TwoMeshes meshes(p);
  const assembly::DiscreteShell& discrete = *meshes.coarse;
  const algebra::Vector y = virtual_part(discrete, meshes.field);
  for (std::size_t i = 0; i < discrete.points.size(); ++i)
    for (std::size_t part : {0, 3}) {
      const Eigen::Map<const Eigen::Vector3d> given(meshes.field.local().data() + 6 * i + part),
          found(y.local().data() + 6 * i + part);
      Eigen::Vector3d expected = given;
      if (part == 3) expected = geometry::tangential(expected, discrete.points[i].a3);
      if (test::is_supported(discrete.coordinates, i)) expected.setZero();
      EXPECT_LT((found - expected).norm(), 1e-13);
    }
}

}  // namespace
}  // namespace plastron::study
