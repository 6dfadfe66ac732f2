#include <plastron/assembly/nodal_coordinates.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>
#include <plastron/assembly/carried_coordinates.hpp>
#include <plastron/assembly/kinked_supports.hpp>
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/assembly/tied_supports.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/obstacle/error.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plastron::assembly {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int packed_size = 36 + 6 + 6 + 1;

void pack(const NodeCoordinates& node, bool supported, double* out) {
  Eigen::Map<NodeBasis>{out} = node.basis;
  for (std::size_t k = 0; k < 6; ++k) {
    out[36 + k] = node.lower[k];
    out[42 + k] = node.upper[k];
  }
  out[48] = supported;
}

/// Returns the rows of a node that no obstacle touches.
std::vector<ContactRow> no_rows(std::size_t obstacles) {
  std::vector<ContactRow> rows;
  for (std::size_t k = 0; k < obstacles; ++k) rows.push_back({.obstacle = static_cast<int>(k), .bound_gap = NAN});
  return rows;
}

}  // namespace

obstacle::ShellPoint shell_point(const Vector3d& phi, const Vector3d& a3, double thickness, const Vector6& moved) {
  return {phi, a3, thickness, moved.head<3>(), geometry::tangential(moved.tail<3>(), a3)};
}

NodalCoordinates nodal_coordinates(std::shared_ptr<const fem::Space> space_pointer, const fem::Surface& surface,
                                   const std::vector<NodalPoint>& points, const std::vector<Support>& supports,
                                   const RigidObstacles& obstacles, element::Formulation formulation,
                                   const State& state) {
  const fem::Space& space = *space_pointer;
  const auto local = static_cast<std::size_t>(space.layout->local_size());
  const int width = element::is_relaxed(formulation) ? 6 : 5;
  NodalCoordinates coordinates{.width = width,
                               .basis = std::vector<NodeBasis>(local),
                               .supported = std::vector<char>(local),
                               .tied = std::vector<char>(local),
                               .space = std::move(space_pointer),
                               .lower = algebra::Vector(space.layout, width),
                               .upper = algebra::Vector(space.layout, width)};
  // Owners decide, other ranks copy: a basis must be equal on all ranks to the last bit.
  for (const fem::Tie& tie : space.ties) coordinates.tied[static_cast<std::size_t>(tie.node)] = 1;
  auto node_support = node_supports(space, surface, points, supports);
  hand_to_masters(space, node_support);
  hand_across_kinks(space, points, node_support);
  const double size = bounding_box(
                          points.size(), [&](std::size_t i) { return points[i].phi; }, space.layout->comm)
                          .longest_side();
  algebra::Vector packed(space.layout, packed_size);
  std::vector<obstacle::Gap> gaps(obstacles.all.size());
  std::vector<double> lifts(gaps.size());
  algebra::in_agreement<SupportError, obstacle::ObstacleError>(space.layout->comm, [&] {
    for (std::size_t k = 0; k < obstacles.all.size(); ++k) {
      auto& of_obstacle = coordinates.gaps.emplace_back();
      for (std::size_t i = 0; i < points.size(); ++i)
        of_obstacle.push_back(
            obstacles.gap(k, shell_point(points[i].phi, points[i].a3, points[i].thickness, state.at(i))));
    }
    for (std::size_t i = 0; i < node_support.size(); ++i) {
      const NodeSupport& s = node_support[i];
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        gaps[k] = coordinates.gaps[k][i];
        lifts[k] = state.lift(i, k);
      }
      const auto node_number = static_cast<algebra::LocalIndex>(i);
      NodeCoordinates node;  // a tied node has no coordinates of its own: columns of zeros, fixed at zero
      if (const auto* carried = space.carried ? space.carried->find(node_number) : nullptr) {
        node = carried_coordinates(*space.carried, *carried, points[i], s, size);
        node.rows = no_rows(gaps.size());
      } else if (coordinates.tied[i]) {
        node.rows = no_rows(gaps.size());
      } else {
        node = node_coordinates(points[i], s, gaps, lifts, state.at(i), size);
      }
      pack(node, !s.displacement.empty() || !s.rotation.empty(), packed.local().data() + i * packed_size);
      for (ContactRow row : node.rows) {
        row.node = i;
        coordinates.rows.push_back(row);
      }
    }
  });
  packed.update_ghosts();

  for (std::size_t i = 0; i < local; ++i) {
    const double* in = packed.local().data() + i * packed_size;
    coordinates.basis[i] = Eigen::Map<const NodeBasis>{in};
    for (int k = 0; k < width; ++k) {
      coordinates.lower.local()[coordinates.at(i, k)] = in[36 + k];
      coordinates.upper.local()[coordinates.at(i, k)] = in[42 + k];
    }
    coordinates.supported[i] = in[48] != 0;
  }
  return coordinates;
}

namespace {

// Works on all nodes. With sizes known at compile time it takes a third of the time.
template <int width>
void times_all_bases(std::span<const NodeBasis> bases, const double* z, double* y) {
  for (std::size_t i = 0; i < bases.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(y + 6 * i).noalias() =
        bases[i].leftCols<width>() * Eigen::Map<const Eigen::Matrix<double, width, 1>>(z + width * i);
}
template <int width>
void add_all_transposed(std::span<const NodeBasis> bases, const double* f, double* z) {
  for (std::size_t i = 0; i < bases.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, width, 1>>(z + width * i).noalias() +=
        bases[i].leftCols<width>().transpose() * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(f + 6 * i);
}

}  // namespace

std::vector<char> NodalCoordinates::prescribed() const {
  std::vector<char> marks(lower.owned().size());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = lower.owned()[i] == upper.owned()[i];
  return marks;
}

void NodalCoordinates::to_cartesian(const algebra::Vector& z, algebra::Vector& y) const {
  PLASTRON_ASSERT(z.block() == width && y.block() == 6 && z.local().size() == at(basis.size(), 0) &&
                      y.local().size() == 6 * basis.size(),
                  z.block(), width, y.block(), z.local().size(), y.local().size(), basis.size());
  if (width == 5)
    times_all_bases<5>(basis, z.local().data(), y.local().data());
  else
    times_all_bases<6>(basis, z.local().data(), y.local().data());
  fem::carry(*space, y);
  fem::spread(*space, y);
}

Vector6 NodalCoordinates::direction(std::size_t node, int k) const {
  const auto* carried = space->carried ? space->carried->find(static_cast<algebra::LocalIndex>(node)) : nullptr;
  if (!carried) return basis[node].col(k);
  return carried->own * basis[node].col(k);
}

void NodalCoordinates::add_transposed(algebra::Vector& f, algebra::Vector& z) const {
  PLASTRON_ASSERT(
      z.block() == width && f.block() == 6 && f.owned().size() == 6 * static_cast<std::size_t>(z.layout()->owned),
      z.block(), width, f.block(), f.owned().size(), z.layout()->owned);
  fem::collect(*space, f);
  fem::hand_back(*space, f);
  const std::span<const NodeBasis> owned(basis.data(), static_cast<std::size_t>(z.layout()->owned));
  if (width == 5)
    add_all_transposed<5>(owned, f.local().data(), z.local().data());
  else
    add_all_transposed<6>(owned, f.local().data(), z.local().data());
}

namespace {

template <int width>
RowMatrix times_bases(const RowMatrix& cartesian, const NodalCoordinates& coordinates,
                      std::span<const algebra::LocalIndex> nodes) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  RowMatrix result(cartesian.rows(), width * n);
  for (Eigen::Index i = 0; i < n; ++i)
    result.middleCols<width>(width * i).noalias() =
        cartesian.middleCols<6>(6 * i) *
        coordinates.basis[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])].leftCols<width>();
  return result;
}

}  // namespace

InCoordinates in_coordinates(const NodalCoordinates& coordinates, std::size_t cell, const RowMatrix& cartesian) {
  const auto times = [&](const RowMatrix& b, std::span<const algebra::LocalIndex> nodes) {
    return coordinates.width == 5 ? times_bases<5>(b, coordinates, nodes) : times_bases<6>(b, coordinates, nodes);
  };
  const fem::Space& space = *coordinates.space;
  const auto nodes = space.nodes(cell);
  const auto carriers = fem::carriers(space, cell);
  if (!carriers && !space.carried) return {{nodes.begin(), nodes.end()}, times(cartesian, nodes)};
  fem::NodeBlocks blocks{{nodes.begin(), nodes.end()}, cartesian};
  if (carriers) {
    blocks = {carriers->nodes, RowMatrix::Zero(cartesian.rows(), 6 * carriers->weights.cols())};
    for (Eigen::Index i = 0; i < carriers->weights.rows(); ++i)
      for (Eigen::Index j = 0; j < carriers->weights.cols(); ++j)
        if (carriers->weights(i, j) != 0)
          blocks.matrix.middleCols<6>(6 * j) += carriers->weights(i, j) * cartesian.middleCols<6>(6 * i);
  }
  blocks = fem::on_carriers(space, std::move(blocks));
  return {blocks.nodes, times(blocks.matrix, blocks.nodes)};
}

}  // namespace plastron::assembly
