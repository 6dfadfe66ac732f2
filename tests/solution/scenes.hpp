// Shells on 3 x 3 cells for the tests of solution/: drawn supports and loads, and the same scene turned by 90 degrees about z.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "assembly/sample_shells.hpp"

namespace plastron::test {

using assembly::Direction;
using assembly::Unknown;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Random = std::mt19937;

inline const std::array<std::string, 4> sides_of_rectangle{"left", "right", "bottom", "top"};

inline double drawn(Random& random, double from = -1, double to = 1) {
  return std::uniform_real_distribution<double>(from, to)(random);
}
inline Vector3d drawn_vector(Random& random, double size = 1) {
  return size * Vector3d(drawn(random), drawn(random), drawn(random));
}
/// A number between 0 and `last`.
inline unsigned drawn_number(Random& random, unsigned last) {
  return std::uniform_int_distribution<unsigned>(0, last)(random);
}

/// A support that prescribes zero for the components in `bits`: 1, 2, 4 are u along three directions, 8, 16, 32 are r.
inline assembly::Support held(const std::string& boundary, unsigned bits,
                              std::array<Direction, 3> along = {Direction::x, Direction::y, Direction::z}) {
  assembly::Support support{.boundary = boundary, .components = {}};
  for (unsigned k = 0; k < 6; ++k)
    if ((bits >> k) % 2 == 1)
      support.components.push_back(
          {k < 3 ? Unknown::displacement : Unknown::rotation, along[k % 3], geometry::Expression(0.0)});
  return support;
}
inline assembly::Support held_at(const Eigen::Vector2d& point, unsigned bits) {
  assembly::Support support = held("", bits);
  support.point = point;
  return support;
}

/// The turn by 90 degrees about z: x becomes y.
inline Eigen::Matrix3d quarter() { return (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(); }
inline std::array<std::string, 3> turned(const std::array<std::string, 3>& chart) {
  return {"-(" + chart[1] + ")", chart[0], chart[2]};
}
/// Prescribed values must be 0.
inline assembly::Support turned(assembly::Support support) {
  for (assembly::PrescribedComponent& c : support.components)
    if (c.direction == Direction::x)
      c.direction = Direction::y;
    else if (c.direction == Direction::y)
      c.direction = Direction::x;
  return support;
}

inline geometry::Expression linear(double constant, double by_x, double by_y) {
  return {std::to_string(constant) + " + (" + std::to_string(by_x) + ")*x + (" + std::to_string(by_y) + ")*y", {}};
}
/// Three drawn functions, linear in x and y, as they are and turned.
struct DrawnVector {
  energy::VectorExpression given{}, turned{};
};
inline DrawnVector drawn_function(Random& random, double size, const Vector3d& mean = Vector3d::Zero()) {
  DrawnVector result;
  const std::array<Eigen::Index, 3> to{1, 0, 2};
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double a = mean[k] + size * drawn(random), b = size * drawn(random), c = size * drawn(random);
    const double sign = k == 1 ? -1 : 1;
    result.given[static_cast<std::size_t>(k)] = linear(a, b, c);
    result.turned[static_cast<std::size_t>(to[static_cast<std::size_t>(k)])] = linear(sign * a, sign * b, sign * c);
  }
  return result;
}

/// A surface on which bodies carry edges.
inline MeshedSurface meshed_with_bodies(const domain::Domain& domain, const std::array<std::string, 3>& chart,
                                        int degree, const std::vector<fem::RigidBody>& bodies) {
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart(chart, {}));
  MeshedSurface m;
  const fem::MeshSequence meshes(domain::coarse_mesh(domain, quadrilateral), degree, MPI_COMM_WORLD,
                                 [&](std::shared_ptr<const fem::Space> space) {
                                   m.surface = std::make_shared<const fem::Surface>(space->coarse, charts);
                                   return fem::with_rigid_bodies(std::move(space), *m.surface, bodies);
                                 });
  m.space = meshes.space();
  return m;
}

/// Length of a boundary with straight sides that each of its local nodes represents, from all cells of this rank.
inline std::map<std::size_t, double> edge_lengths(const assembly::DiscreteShell& discrete,
                                                  const std::string& boundary) {
  const fem::Space& space = discrete.space();
  const std::vector<double> weights = mesh::gauss_lobatto(space.degree + 1).weights;
  std::map<std::size_t, double> lengths;
  for (const fem::BoundarySide& side : space.sides) {
    if (side.boundary < 0 || space.coarse->boundaries[static_cast<std::size_t>(side.boundary)] != boundary) continue;
    const auto on_side = mesh::side_nodes(space.shape(), space.degree, side.side);
    const auto node = [&](int i) {
      return static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(i)]);
    };
    const double length =
        (discrete.points[node(on_side.back())].phi - discrete.points[node(on_side.front())].phi).norm();
    for (std::size_t i = 0; i < weights.size(); ++i) lengths[node(on_side[i])] += weights[i] * length;
  }
  return lengths;
}

}  // namespace plastron::test
