#include <plastron/estimation/free_edges.hpp>

#include <plastron/assembly/contact_coordinates.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/shell/material.hpp>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace plastron::estimation {

namespace {

using Eigen::Vector2d;
using geometry::Vector3d;

/// The number of cells at each local node.
algebra::Vector cells_at_nodes(const fem::Space& space) {
  algebra::Vector count(space.layout, 1);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (const auto node : space.nodes(cell)) count.local()[static_cast<std::size_t>(node)] += 1;
  count.accumulate_ghosts();
  count.update_ghosts();
  return count;
}

/// Part of the energy of exp(-s) that polynomials represent, relative to the work at s = 0. The polynomials have
/// degree k on 0 < s < x and vanish at x.
double energy_share_of_polynomials(int degree, double x) {
  const mesh::Rule rule = mesh::gauss(degree + 1);
  Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(degree, degree);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    // Products of 1 - t with Chebyshev polynomials, t = s/x.
    Eigen::VectorXd value(degree), slope(degree);
    const double t = rule.points[q], angle = std::acos(2 * t - 1);
    for (int i = 0; i < degree; ++i) {
      value[i] = (1 - t) * std::cos(i * angle);
      slope[i] = -std::cos(i * angle) + (1 - t) * 2 * i * std::sin(i * angle) / std::sin(angle);
    }
    energy += rule.weights[q] * (slope * slope.transpose() / x + x * value * value.transpose());
  }
  Eigen::VectorXd at_edge(degree);
  for (int i = 0; i < degree; ++i) at_edge[i] = i % 2 == 0 ? 1 : -1;
  return at_edge.dot(energy.ldlt().solve(at_edge));
}

class FreeEdgesOf {
 public:
  explicit FreeEdgesOf(const assembly::DiscreteShell& discrete)
      : discrete_(discrete),
        space_(discrete.space()),
        cells_at_(cells_at_nodes(space_)),
        load_(loads_and_initial_forces(discrete)),
        line_(mesh::gauss(space_.degree + 1)) {
    load_.update_ghosts();
  }

  /// Returns the free edge; empty if the side is none.
  std::optional<FreeEdge> operator()(const fem::BoundarySide& side) const {
    if (side.is_inner || space_.degree < 2) return {};
    FreeEdge edge{.cell = side.cell};
    for (const double t : line_.points) edge.xi.push_back(mesh::side_point(space_.shape(), side.side, t));
    std::vector<geometry::Frame> frames(edge.xi.size());
    discrete_.shell.surface().frames(space_.cells[side.cell], edge.xi, frames, false);
    const Vector2d along = mesh::side_tangent(space_.shape(), side.side);
    std::vector<double> lengths;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Vector3d derivative = geometry::along(frames[i], along);
      edge.tangent.push_back(derivative.normalized());
      lengths.push_back(line_.weights[i] * derivative.norm());
    }
    if (!is_free(side)) return {};
    edge.weight = weights(edge, frames, lengths);
    return edge;
  }

 private:
  bool is_free(const fem::BoundarySide& side) const {
    const std::vector<int> on_side = mesh::side_nodes(space_.shape(), space_.degree, side.side);
    return std::ranges::all_of(std::span(on_side).subspan(1, on_side.size() - 2), [&](int k) {
      const auto node = static_cast<std::size_t>(space_.nodes(side.cell)[static_cast<std::size_t>(k)]);
      return cells_at_.local()[node] == 1 && !has_couple(node) &&
             std::ranges::all_of(assembly::across(discrete_.place(node).a3),
                                 [&](const Vector3d& direction) { return may_turn(node, direction); });
    });
  }

  std::vector<double> weights(const FreeEdge& edge, std::span<const geometry::Frame> frames,
                              std::vector<double> lengths) const {
    const energy::ShellOperator& shell = discrete_.shell;
    std::vector<double> e(edge.xi.size());
    const energy::CrossSection& section = shell.section(edge.cell);
    shell.surface().evaluate(section.thickness, space_.cells[edge.cell], edge.xi, e);
    const double width = shell.area(edge.cell) / std::accumulate(lengths.begin(), lengths.end(), 0.0);
    for (std::size_t i = 0; i < e.size(); ++i) {
      const shell::Section along =
          shell::section_at(section.material, shell::frame_across(edge.tangent[i], frames[i].a3), e[i]);
      const double delta = shell::twist_length(along);
      const double cell = width / delta;
      // Within the layer M_nt is an ordinary residual, weighted with the cell's width.
      const double missing = (1 - energy_share_of_polynomials(space_.degree, cell)) * std::min(1.0, cell);
      lengths[i] *= missing * delta / along.bending_without_force()(2, 2);
    }
    return lengths;
  }

  bool has_couple(std::size_t node) const {
    const std::span<const double> f = load_.at(node);
    return std::any_of(f.begin() + 3, f.end(), [](double c) { return c != 0; });
  }

  /// Whether r may have a component in a tangential direction, given the coordinates that supports prescribe.
  bool may_turn(std::size_t node, const Vector3d& direction) const {
    const assembly::NodalCoordinates& coordinates = discrete_.coordinates;
    Eigen::MatrixXd free(6, 0);
    for (int k = 0; k < coordinates.width; ++k) {
      if (coordinates.is_prescribed(node, k)) continue;
      free.conservativeResize(Eigen::NoChange, free.cols() + 1);
      free.rightCols<1>() = coordinates.direction(node, k);
    }
    if (free.cols() == 0) return false;
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(6);
    wanted.tail<3>() = direction;
    constexpr double most_held = 0.3;  // sine
    return (free * free.completeOrthogonalDecomposition().solve(wanted) - wanted).norm() < most_held;
  }

  const assembly::DiscreteShell& discrete_;
  const fem::Space& space_;
  algebra::Vector cells_at_, load_;
  mesh::Rule line_;
};

}  // namespace

std::vector<FreeEdge> free_edges(const assembly::DiscreteShell& discrete) {
  const FreeEdgesOf make(discrete);
  std::vector<FreeEdge> all;
  for (const fem::BoundarySide& side : discrete.space().sides)
    if (side.cell < discrete.space().owned_cells)
      if (auto edge = make(side)) all.push_back(std::move(*edge));
  std::ranges::stable_sort(all, {}, &FreeEdge::cell);
  return all;
}

}  // namespace plastron::estimation
