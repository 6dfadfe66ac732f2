#include <plastron/zones/gap_opening.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/zones/sub_cells.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace plastron::zones {

namespace {

using Eigen::Vector2d;

/// Marks the touching local nodes and, in `rings` steps, the nodes that share a sub-cell with a marked one
/// (collective).
std::vector<char> near_zones(const fem::Space& space, std::span<const char> touching, int rings) {
  std::vector<char> near(touching.begin(), touching.end());
  for (int ring = 0; ring < rings; ++ring) {
    algebra::Vector neighbours(space.layout, 1);
    for_neighbours(space, [&](algebra::LocalIndex a, algebra::LocalIndex b) {
      neighbours.local()[static_cast<std::size_t>(a)] += near[static_cast<std::size_t>(b)];
    });
    make_whole(space, neighbours);
    for (std::size_t i = 0; i < near.size(); ++i)
      if (neighbours.local()[i] > 0.1) near[i] = 1;  // weights at hanging nodes have both signs: 0 may be rounding
  }
  return near;
}

/// Solves s^2 (3 + s) = gap for s >= 0.
double opened_distance(double gap) {
  double s = std::min(std::sqrt(gap / 3),
                      std::cbrt(gap));  // not below the solution: Newton's method converges from above
  for (int i = 0; i < 60 && s > 0; ++i) {
    const double step = (s * s * (3 + s) - gap) / (s * (6 + 3 * s));
    s -= step;
    if (std::abs(step) <= 1e-15 * s) break;
  }
  return s;
}

/// A polynomial of degree 2 in the plane: 1, p_1, p_2, p_1^2, p_1 p_2, p_2^2.
using Quadratic = Eigen::Matrix<double, 6, 1>;

Quadratic monomials(const Vector2d& p) {
  return (Quadratic() << 1, p[0], p[1], p[0] * p[0], p[0] * p[1], p[1] * p[1]).finished();
}
Vector2d gradient(const Quadratic& c, const Vector2d& p) {
  return {c[1] + 2 * c[3] * p[0] + c[4] * p[1], c[2] + c[4] * p[0] + 2 * c[5] * p[1]};
}

/// The zero found by Newton's method from the origin, along the gradient or along a given direction; nothing outside
/// of the unit disk.
std::optional<Vector2d> zero_of(const Quadratic& c, const std::optional<Vector2d>& along) {
  Vector2d p = Vector2d::Zero();
  for (int i = 0; i < 30; ++i) {
    const Vector2d slope = gradient(c, p), direction = along.value_or(slope);
    const Vector2d step = c.dot(monomials(p)) / slope.dot(direction) * direction;
    p -= step;
    if (!(p.norm() < 1)) return {};
    if (step.norm() < 1e-12) return p;
  }
  return {};
}

/// Gaps at nodes as distances from the edge, and the polynomial fitted to them. Lengths are divided by the radius at
/// which weights vanish. Which of several nodes near this radius enter does not matter.
class DistanceFit {
 public:
  DistanceFit(const EdgeSearch& search, double radius)
      : search_(search), radius_(radius), delta_(search.shear_length / radius) {}

  void add(const Vector3d& place, double gap) {
    const Vector3d way = (place - search_.from) / radius_;
    const double weight = std::max(1 - way.squaredNorm(), 0.0);
    terms_.push_back(weight * monomials(search_.axes.transpose() * way));
    weights_.push_back(weight);
    gaps_.push_back(gap);
  }

  std::optional<Vector3d> way_to_edge() const {
    const double largest = *std::ranges::max_element(gaps_);
    if (!(largest > 0)) return {};
    const auto rows = static_cast<Eigen::Index>(terms_.size());
    const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> terms(terms_.front().data(), 6, rows);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit;
    // Detects a polynomial that vanishes at all nodes: weights at the radius are rounding.
    fit.setThreshold(1e-6);
    fit.compute(terms.transpose());
    double c = largest / (3 * delta_ + 1);
    for (int i = 0; i < 100; ++i) {
      const Eigen::VectorXd distances = weighted_distances(c);
      const Quadratic polynomial = fit.solve(distances);
      const auto zero = zero_of(polynomial, search_.along);
      if (!zero) return {};
      const Vector2d slope = gradient(polynomial, *zero);
      if (std::abs(slope.norm() - 1) < 1e-10) {
        const double misfit = (distances - terms.transpose() * polynomial).norm() / all_weights();
        return is_trusted(*zero, slope, misfit) ? std::optional(Vector3d(radius_ * (search_.axes * *zero)))
                                                : std::nullopt;
      }
      c *= slope.squaredNorm();
    }
    return {};
  }

 private:
  Eigen::VectorXd weighted_distances(double c) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(gaps_.size()));
    for (std::size_t i = 0; i < gaps_.size(); ++i)
      result[static_cast<Eigen::Index>(i)] =
          weights_[i] * delta_ * opened_distance(gaps_[i] / (c * delta_ * delta_ * delta_));
    return result;
  }
  double all_weights() const { return Eigen::Map<const Eigen::VectorXd>(weights_.data(), std::ssize(weights_)).norm(); }

  bool is_trusted(const Vector2d& zero, const Vector2d& slope, double misfit) const {
    constexpr double well_fitted = 0.1;
    const double node_distance =
        std::sqrt(std::numbers::pi / (2.0 * static_cast<double>(gaps_.size())));  // nodes in half a disk
    return zero.norm() <= node_distance && misfit <= well_fitted * node_distance &&
           slope.dot(search_.axes.transpose() * search_.inwards) < 0.6 * search_.inwards.norm();
  }

  const EdgeSearch& search_;
  double radius_, delta_;
  std::vector<Quadratic> terms_{};  // weighted
  std::vector<double> weights_{}, gaps_{};
};

}  // namespace

GapOpening::GapOpening(const assembly::DiscreteShell& discrete, const TouchingNodes& touching) {
  constexpr int rings = 6;  // as many as `count` nodes of way_to_edge() need on one side of a line
  const fem::Space& space = discrete.space();
  std::vector<char> is_free(touching.inside().begin(), touching.inside().end());
  for (char& mark : is_free) mark = mark ? 0 : 1;
  parts_ = zone_labels(space, is_free);
  const std::vector<char> near = near_zones(space, touching.inside(), rings);
  std::vector<std::pair<int, FreeNode>> mine;  // the part of each node
  for (std::size_t i = 0; i < static_cast<std::size_t>(space.layout->owned); ++i) {
    const assembly::NodalPoint& p = discrete.points[i];
    if (!is_free[i] || !near[i] || p.weight == 0 || space.continuity.constrains(i)) continue;
    const double root = touching.roots()[i];
    mine.emplace_back(parts_.of_node[i], FreeNode{p.phi, root * root});
  }
  nodes_.resize(static_cast<std::size_t>(parts_.count));
  for (const auto& [part, node] : algebra::gathered(mine, space.layout->comm))
    nodes_[static_cast<std::size_t>(part)].push_back(node);
}

std::optional<Vector3d> GapOpening::way_to_edge(algebra::LocalIndex free, const EdgeSearch& search) const {
  const int part = parts_.of_node[static_cast<std::size_t>(free)];
  if (part < 0) return {};
  const std::vector<FreeNode>& nodes = nodes_[static_cast<std::size_t>(part)];
  std::vector<std::pair<double, const FreeNode*>> ordered;  // ordered by distance
  ordered.reserve(nodes.size());
  for (const FreeNode& node : nodes) ordered.emplace_back((node.place - search.from).norm(), &node);
  // Many nodes suit a smooth edge best, few nodes a strongly curved one.
  for (const std::size_t count : {30U, 16U}) {
    if (ordered.size() <= count) continue;
    std::ranges::nth_element(ordered, ordered.begin() + count, {}, [](const auto& n) { return n.first; });
    DistanceFit fit(search, ordered[count].first);
    for (std::size_t i = 0; i < count; ++i) fit.add(ordered[i].second->place, ordered[i].second->gap);
    if (auto way = fit.way_to_edge()) return way;
  }
  return {};
}

}  // namespace plastron::zones
