#include <plastron/finite/motion_curvature.hpp>
#include <plastron/finite/scalar_blocks.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace plastron::finite {

using algebra::LocalIndex;
using assembly::node_values;
using assembly::RowMatrix;
using Eigen::Matrix3d, Eigen::Vector3d;

namespace {

void add(const constraints::NodeColumns& k, algebra::Matrix& matrix) {
  matrix.add(k.nodes, {k.matrix.data(), static_cast<std::size_t>(k.matrix.size())});
}

/// Adds factor |r|^2 of a node.
void add_rotation(double factor, LocalIndex node, const assembly::NodalCoordinates& coordinates,
                  algebra::Matrix& matrix) {
  RowMatrix k = RowMatrix::Zero(6, 6);
  k.bottomRightCorner<3, 3>().diagonal().setConstant(factor);
  add(on_both_sides(coordinates, {&node, 1}, std::move(k)), matrix);
}

/// Returns the symmetric matrix of f . (w x (w x p)).
Matrix3d curvature_of_turn(const Vector3d& f, const Vector3d& p) {
  const Matrix3d product = f * p.transpose();
  return (product + product.transpose()) / 2 - f.dot(p) * Matrix3d::Identity();
}

void add_curvature_of_body(const fem::PlacedBody& placed, const algebra::Vector& forces,
                           const assembly::NodalCoordinates& coordinates, algebra::Matrix& matrix) {
  const algebra::Layout& layout = *coordinates.space->layout;
  Matrix3d sum = Matrix3d::Zero();  // for length w
  for (const fem::BodyNode& member : placed.members) {
    if (member.node >= layout.owned) continue;
    const assembly::Vector6 f = node_values(forces, static_cast<std::size_t>(member.node));
    for (const int part : {0, 3}) {
      const Matrix3d motion = member.motion.block<3, 3>(part, 3);
      sum += curvature_of_turn(f.segment<3>(part), fem::turned_vector(motion) / placed.length);
    }
  }
  for (double& entry : sum.reshaped()) entry = algebra::sum_over_ranks(entry, layout.comm);
  const LocalIndex host = placed.hosts[1];
  if (host < 0 || host >= layout.owned) return;
  const RowMatrix turn = coordinates.basis[static_cast<std::size_t>(host)].topRows<3>().leftCols(coordinates.width);
  add({.nodes = {host}, .matrix = turn.transpose() * sum * turn}, matrix);
}

/// Whether a body decides the director of a node.
bool is_turned_by_body(const fem::Space& space, LocalIndex node) {
  return std::ranges::any_of(
      space.bodies, [&](const fem::PlacedBody& placed) { return placed.body.turns_normals && placed.find(node); });
}

}  // namespace

void add_curvature_of_motions(const assembly::DiscreteShell& discrete, algebra::Vector forces,
                              const assembly::NodalCoordinates& coordinates, algebra::Matrix& matrix) {
  const fem::Space& space = *coordinates.space;
  space.continuity.apply_transposed(forces);
  for (LocalIndex node = 0; node < space.layout->owned; ++node) {
    const auto i = static_cast<std::size_t>(node);
    if (space.continuity.constrains(i) || is_turned_by_body(space, node)) continue;
    const Vector3d couple = node_values(forces, i).tail<3>();
    const Vector3d& d = discrete.place(i).a3;
    add_rotation(-couple.dot(d) / d.squaredNorm(), node, coordinates, matrix);
  }
  for (const fem::PlacedBody& placed : space.bodies) add_curvature_of_body(placed, forces, coordinates, matrix);
}

}  // namespace plastron::finite
