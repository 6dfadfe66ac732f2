#include <plastron/solution/support_shares.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/solution/place_order.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

namespace plastron::solution {

namespace {

using assembly::NodeSupport;
using Eigen::Vector3d;

/// The eigenvalues of (P + Q)/2 for two projectors are (1 - cos)/2 and (1 + cos)/2 of the angles between their
/// spaces. Below four degrees two directions count as one, because their separate forces would be rounding.
constexpr double least_part = 1e-3;
/// Edges that meet at less than this angle, one degree, continue each other (assembly/node_supports.cc).
constexpr double corner_sine = 0.0175;
/// In the layer at a supported edge Q decays like exp(-s sqrt(12 k_s)/e). A corner's force is spread over this number
/// of thicknesses.
constexpr double layer_reach = 2;
/// Largest part of a short edge within a corner's reach.
constexpr double most_of_edge = 0.1;

/// Projector on the eigenvectors of a symmetric matrix whose eigenvalues are above `least`.
Matrix6 projector_above(const Matrix6& A, double least) {
  const auto eigen = geometry::symmetric_eigen(Eigen::MatrixXd(A));
  Matrix6 projector = Matrix6::Zero();
  for (Eigen::Index k = 0; k < 6; ++k)
    if (eigen.values[k] > least) projector += eigen.vectors.col(k) * eigen.vectors.col(k).transpose();
  return projector;
}

Matrix6 intersection(const Matrix6& P, const Matrix6& Q) { return projector_above((P + Q) / 2, 1 - least_part); }
Matrix6 span_of(const Matrix6& sum) { return projector_above(sum, least_part); }

/// Projector on the directions of (u, r) that the rows fix. A support that prescribes a rotation fixes r . a_3 too.
Matrix6 fixed_by(const NodeSupport& rows, const Vector3d& a3) {
  Matrix6 sum = Matrix6::Zero();
  for (const auto& [d, value] : rows.displacement) sum.topLeftCorner<3, 3>() += d * d.transpose();
  for (const auto& [d, value] : rows.rotation) sum.bottomRightCorner<3, 3>() += d * d.transpose();
  if (!rows.rotation.empty()) sum.bottomRightCorner<3, 3>() += a3 * a3.transpose();
  return span_of(sum);
}

/// The rows of a subset of supports (collective).
std::vector<NodeSupport> rows_of(const std::vector<assembly::Support>& some, const assembly::DiscreteShell& discrete) {
  return assembly::node_supports(discrete.space(), discrete.shell.surface(), discrete.points, some);
}

/// Length of edge represented by each node, and the sum of the unit tangents of the sides that leave it; block 4
/// (collective).
algebra::Vector edge_at_nodes(const assembly::DiscreteShell& discrete, const std::string& boundary) {
  const fem::Space& space = discrete.space();
  const mesh::Rule line = mesh::gauss_lobatto(space.degree + 1);
  algebra::Vector edge(space.layout, 4);
  std::vector<geometry::Frame> frames(line.points.size());
  for (const fem::BoundarySide& side : space.sides) {
    if (side.cell >= space.owned_cells || side.boundary < 0) continue;
    if (space.coarse->boundaries[static_cast<std::size_t>(side.boundary)] != boundary) continue;
    std::vector<Eigen::Vector2d> xi;
    for (const double t : line.points) xi.push_back(mesh::side_point(space.shape(), side.side, t));
    discrete.shell.surface().frames(space.cells[side.cell], xi, frames, false);
    const Eigen::Vector2d along = mesh::side_tangent(space.shape(), side.side);
    const auto on_side = mesh::side_nodes(space.shape(), space.degree, side.side);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const Vector3d tangent = geometry::along(frames[i], along);
      double* at = edge.local().data() +
                   4 * static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(on_side[i])]);
      at[0] += line.weights[i] * tangent.norm();
      const double leaves = i == 0 ? 1 : i + 1 == xi.size() ? -1 : 0;
      Eigen::Map<Vector3d>(at + 1) += leaves * tangent.normalized();
    }
  }
  edge.accumulate_ghosts();
  space.continuity.apply_transposed(edge);
  return edge;
}

/// One edge of a corner, with the distance of the first node outside of the corner's reach.
struct CornerEdge {
  std::size_t corner = 0, boundary = 0;
  double nearest = std::numeric_limits<double>::infinity();
  double length_within = 0, length_next = 0;  ///< length of edge represented by nodes
  double continuation() const { return length_next > 0 ? length_within / length_next : 0; }
};

}  // namespace

/// Constraint of one carrier at a node.
struct SupportShares::Holding {
  std::size_t carrier = 0;
  bool is_point = false;
  Matrix6 fixed = Matrix6::Zero();    ///< projector on the fixed directions of (u, r)
  double length = 0;                  ///< length of its edge represented by the node [m]
  Vector3d along = Vector3d::Zero();  ///< sum of the unit tangents of its sides that leave the node
};

namespace {

/// Splits the force f at a node into parts M f, each in the directions fixed by its carrier. The sum of their squares
/// over the lengths of edges is least.
template <class Holdings>
std::vector<Matrix6> parts_of(const Holdings& holdings) {
  std::vector<Matrix6> parts(holdings.size(), Matrix6::Identity());
  if (holdings.size() < 2) return parts;
  double length = 0;
  Matrix6 by_edges = Matrix6::Zero();
  for (const auto& h : holdings) {
    length += h.length;
    if (!h.is_point) by_edges += h.fixed;
  }
  by_edges = span_of(by_edges);
  std::vector<double> weights;
  std::vector<Matrix6> fixed;
  Matrix6 sum = Matrix6::Zero();
  for (const auto& h : holdings) {
    weights.push_back(h.is_point || !(length > 0) ? 1 : h.length / length);
    fixed.push_back(h.is_point ? span_of(h.fixed - intersection(h.fixed, by_edges)) : h.fixed);
    sum += weights.back() * fixed.back();
  }
  const auto eigen = geometry::symmetric_eigen(Eigen::MatrixXd(sum));
  Matrix6 inverse = Matrix6::Zero();
  for (Eigen::Index k = 0; k < 6; ++k)
    if (eigen.values[k] > least_part)
      inverse += eigen.vectors.col(k) * eigen.vectors.col(k).transpose() / eigen.values[k];
  Matrix6 rest = Matrix6::Identity();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k] = weights[k] * fixed[k] * inverse;
    rest -= parts[k];
  }
  // Rounding, and directions that count as one: divided by length, among edges if there are any.
  const bool has_edge = std::ranges::any_of(holdings, [](const auto& h) { return !h.is_point; });
  double whole = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) whole += has_edge && holdings[k].is_point ? 0 : weights[k];
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!(has_edge && holdings[k].is_point)) parts[k] += weights[k] / whole * rest;
  return parts;
}

/// Whether two edges that meet at a node make a corner there. They make none if they continue each other or coincide.
template <class Holding>
bool is_corner(const Holding& a, const Holding& b) {
  // Limit of the norm of the sum of tangents: 0 for an edge that passes, 1 for an edge that ends.
  constexpr double ends = 0.5;
  const bool a_ends = a.along.norm() > ends, b_ends = b.along.norm() > ends;
  if (a_ends != b_ends) return true;
  return a_ends && a.along.cross(b.along).norm() > corner_sine;
}

}  // namespace

SupportShares::SupportShares(const assembly::DiscreteShell& discrete) {
  for (const assembly::Support& support : discrete.supports)
    if (!support.point && std::ranges::find(boundaries_, support.boundary) == boundaries_.end())
      boundaries_.push_back(support.boundary);
  points_ = discrete.support_points().size();
  const Holdings all = holdings(discrete);
  find_corners(discrete, all);
  share(discrete, all);
}

const std::vector<SupportShares::Share>& SupportShares::at(std::size_t node) const {
  static const std::vector<Share> none;
  const auto found = shares_.find(node);
  return found == shares_.end() ? none : found->second;
}

SupportShares::Holdings SupportShares::holdings(const assembly::DiscreteShell& discrete) const {
  Holdings all;
  const auto add = [&](std::size_t carrier, bool is_point, const std::vector<NodeSupport>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!rows[i].displacement.empty() || !rows[i].rotation.empty())
        all[i].push_back({.carrier = carrier, .is_point = is_point, .fixed = fixed_by(rows[i], discrete.place(i).a3)});
  };
  const auto those = [&](const auto& belongs) {
    std::vector<assembly::Support> some;
    std::ranges::copy_if(discrete.supports, std::back_inserter(some), belongs);
    return some;
  };
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    add(b, false, rows_of(those([&](const auto& s) { return !s.point && s.boundary == boundaries_[b]; }), discrete));
    const algebra::Vector edge = edge_at_nodes(discrete, boundaries_[b]);
    for (auto& [node, at] : all)
      if (at.back().carrier == b) {
        at.back().length = edge.local()[4 * node];
        at.back().along = Eigen::Map<const Vector3d>(edge.local().data() + 4 * node + 1);
      }
  }
  const auto points = discrete.support_points();
  // Corners are not known yet: points follow directly after boundaries for now.
  for (std::size_t k = 0; k < points.size(); ++k)
    add(boundaries_.size() + k, true, rows_of(those([&](const auto& s) { return s.point == points[k]; }), discrete));
  return all;
}

void SupportShares::find_corners(const assembly::DiscreteShell& discrete, const Holdings& all) {
  const MPI_Comm comm = discrete.space().layout->comm;
  std::vector<double> lengths(boundaries_.size(), 0);
  std::vector<CornerPlace> mine;
  std::vector<std::size_t> edges;  // of one corner after the other
  for (const auto& [node, at] : all)
    for (const Holding& h : at)
      if (!h.is_point) lengths[h.carrier] += h.length;
  lengths = algebra::sums_over_ranks(lengths, comm);
  for (const auto& [node, at] : all) {
    CornerPlace corner{.at = discrete.points[node].x, .place = discrete.points[node].phi};
    corner.reach = layer_reach * discrete.points[node].thickness;
    std::set<std::size_t> boundaries;
    for (const Holding& a : at)
      for (const Holding& b : at) {
        if (a.is_point || b.is_point || a.carrier >= b.carrier || !is_corner(a, b)) continue;
        const Matrix6 both = intersection(a.fixed, b.fixed);
        if (both.isZero(0)) continue;
        corner.shared += both;
        boundaries.insert({a.carrier, b.carrier});
      }
    if (boundaries.empty()) continue;
    corner.shared = span_of(corner.shared);
    corner.edges = boundaries.size();
    for (const std::size_t b : boundaries) corner.reach = std::min(corner.reach, most_of_edge * lengths[b]);
    mine.push_back(corner);
    edges.insert(edges.end(), boundaries.begin(), boundaries.end());
  }
  edges = algebra::gathered(edges, comm);
  auto next = edges.begin();
  for (const CornerPlace& corner : algebra::gathered(mine, comm)) {
    const auto end = next + static_cast<std::ptrdiff_t>(corner.edges);
    corners_.push_back({corner, {next, end}});
    next = end;
  }
  double size = 0;
  for (const assembly::NodalPoint& p : discrete.points) size = std::max(size, p.phi.cwiseAbs().maxCoeff());
  size = algebra::max_over_ranks(size, comm);
  std::ranges::sort(corners_, {}, [&](const SupportCorner& corner) { return in_units(corner.place, size); });
}

void SupportShares::share(const assembly::DiscreteShell& discrete, const Holdings& all) {
  const MPI_Comm comm = discrete.space().layout->comm;
  constexpr double rounding = 1e-6;
  const auto distance = [&](std::size_t node, std::size_t corner) {
    return (discrete.points[node].phi - corners_[corner].place).norm();
  };
  std::vector<CornerEdge> edges;
  std::vector<std::vector<std::size_t>> of_boundary(boundaries_.size());  // indices in `edges`
  for (std::size_t c = 0; c < corners_.size(); ++c)
    for (const std::size_t b : corners_[c].boundaries) {
      of_boundary[b].push_back(edges.size());
      edges.push_back({.corner = c, .boundary = b});
    }
  // The corner in whose reach an edge's node lies.
  const auto reached = [&](std::size_t node, const Holding& h) -> std::optional<std::size_t> {
    std::optional<std::size_t> found;
    if (h.is_point) return found;
    for (const std::size_t e : of_boundary[h.carrier]) {
      const double d = distance(node, edges[e].corner);
      if (d > (1 + rounding) * corners_[edges[e].corner].reach) continue;
      if (!found || d < distance(node, edges[*found].corner)) found = e;
    }
    return found;
  };
  // Calls visit(edge, node's holding, its distance, is within reach).
  const auto for_edge_nodes = [&](const auto& visit) {
    for (const auto& [node, at] : all)
      for (const Holding& h : at) {
        if (h.is_point || !(h.length > 0)) continue;
        const auto within = reached(node, h);
        for (const std::size_t e : of_boundary[h.carrier])
          if (!within || *within == e) visit(edges[e], h, distance(node, edges[e].corner), within.has_value());
      }
  };
  for_edge_nodes([](CornerEdge& edge, const Holding& h, double d, bool is_within) {
    if (is_within)
      edge.length_within += h.length;
    else
      edge.nearest = std::min(edge.nearest, d);
  });
  for (CornerEdge& edge : edges) {
    edge.nearest = algebra::min_over_ranks(edge.nearest, comm);
    edge.length_within = algebra::sum_over_ranks(edge.length_within, comm);
  }
  const auto is_next = [](const CornerEdge& edge, double d) { return d <= (1 + rounding) * edge.nearest; };
  for_edge_nodes([&](CornerEdge& edge, const Holding& h, double d, bool is_within) {
    if (!is_within && is_next(edge, d)) edge.length_next += h.length;
  });
  for (CornerEdge& edge : edges) edge.length_next = algebra::sum_over_ranks(edge.length_next, comm);

  for (const auto& [node, at] : all) {
    const std::vector<Matrix6> parts = parts_of(at);
    std::vector<Share>& shares = shares_[node];
    const auto add = [&shares](std::size_t carrier, const Matrix6& part) {
      const auto found = std::ranges::find(shares, carrier, &Share::carrier);
      if (found == shares.end())
        shares.push_back({carrier, part});
      else
        found->part += part;
    };
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Holding& h = at[k];
      add(h.carrier + (h.is_point ? corners_.size() : 0), parts[k]);
      if (h.is_point) continue;
      const auto move = [&](const CornerEdge& edge, double factor) {  // from the edge to the corner
        const Matrix6 part = factor * corners_[edge.corner].shared * parts[k];
        add(h.carrier, -part);
        add(boundaries_.size() + edge.corner, part);
      };
      const auto within = reached(node, h);
      if (within && edges[*within].length_next > 0) move(edges[*within], 1);
      if (within || !(h.length > 0)) continue;
      for (const std::size_t e : of_boundary[h.carrier])
        if (is_next(edges[e], distance(node, edges[e].corner))) move(edges[e], -edges[e].continuation());
    }
  }
}

}  // namespace plastron::solution
