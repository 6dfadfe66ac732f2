#include <plastron/assembly/node_coordinates.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/assembly/contact_coordinates.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace plastron::assembly {

namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

using Eigen::Vector2d;

/// Orthonormal directions in R^3: prescribed ones and free ones.
struct Split {
  std::vector<Vector3d> prescribed;
  std::vector<double> values;
  std::vector<Vector3d> free;
};

/// Scales against which the rows of one unknown at a node are compared.
struct Scales {
  double value;     ///< the largest value that the node's supports prescribe
  double rounding;  ///< rounding of a value that should be zero
};

/// Splits the plane or space orthogonal to `excluded` (empty: all of R^3) by the prescribed rows.
Split split(const std::vector<std::pair<Vector3d, double>>& rows, const std::vector<Vector3d>& excluded,
            const Vector2d& x, const Scales& scales) {
  // Directions that differ by less than this angle are equal. Conormals of two boundaries that meet smoothly differ by
  // the rounding of the mesh's nodes, 1e-16 to 1e-7. A component that is the quotient of two such differences
  // would be noise. Beyond the angle the rounding of a value is magnified by 1e4 at most.
  constexpr double same_direction = 1e-4;
  constexpr double precision = 1e-9;
  Split result;
  std::vector<Vector3d> basis(excluded);
  for (const auto& [direction, value] : rows) {
    Vector3d d = direction;
    for (const Vector3d& q : excluded) d -= q.dot(d) * q;
    // Value of this component that the earlier directions already prescribe:
    double known = 0;
    for (std::size_t k = 0; k < result.prescribed.size(); ++k) {
      const double share = result.prescribed[k].dot(d);
      known += share * result.values[k];
      d -= share * result.prescribed[k];
    }
    if (d.norm() > same_direction) {
      result.values.push_back((value - known) / d.norm());
      result.prescribed.push_back(d.normalized());
      basis.push_back(result.prescribed.back());
    } else if (!(std::abs(value - known) <= (precision + d.norm()) * scales.value + scales.rounding)) {
      throw SupportError(
          fmt::format("supports contradict each other at x = {:g}, y = {:g}: a component that is already "
                      "prescribed as {:g} is to be {:g}, which differs by {:.2g}",
                      x[0], x[1], known, value, std::abs(value - known)));
    }
  }
  if (basis.empty()) {
    result.free = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  } else if (basis.size() == 1) {
    const auto pair = across(basis[0]);
    result.free = {pair[0], pair[1]};
  } else if (basis.size() == 2) {
    result.free = {basis[0].cross(basis[1]).normalized()};
  }
  return result;
}

void prescribe(const Split& u, const Split& r, const std::vector<ContactColumn>& free, NodeCoordinates& node) {
  Eigen::Index next = 0;
  const auto add = [&](const Vector3d& du, const Vector3d& dr, double lower, double upper) {
    node.basis.col(next) << du, dr;
    node.lower[static_cast<std::size_t>(next)] = lower;
    node.upper[static_cast<std::size_t>(next)] = upper;
    ++next;
  };
  for (const ContactColumn& column : free) add(column.u, column.r, -no_bound, no_bound);
  for (std::size_t k = 0; k < u.prescribed.size(); ++k)
    add(u.prescribed[k], Vector3d::Zero(), u.values[k], u.values[k]);
  for (std::size_t k = 0; k < r.prescribed.size(); ++k)
    add(Vector3d::Zero(), r.prescribed[k], r.values[k], r.values[k]);
}

/// Returns the gap where all free components are zero.
double gap_of_prescribed(const obstacle::Gap& gap, const Split& u, const Split& r) {
  double value = gap.initial;
  for (std::size_t k = 0; k < u.prescribed.size(); ++k) value += gap.normal.dot(u.prescribed[k]) * u.values[k];
  for (std::size_t k = 0; k < r.prescribed.size(); ++k)
    value += gap.arm * gap.normal.dot(r.prescribed[k]) * r.values[k];
  return value;
}

/// Sets the bounds of the coordinates from their rows. The tightest row on each side of a coordinate binds; of equal
/// rows the first.
void bound(NodeCoordinates& node) {
  std::array<ContactRow*, 6> below{}, above{};
  for (ContactRow& row : node.rows) {
    if (!row.is_touchable()) continue;
    const auto k = static_cast<std::size_t>(row.coordinate);
    const double value = -row.bound_gap / row.scale;
    ContactRow*& tightest = row.scale > 0 ? below[k] : above[k];
    double& limit = row.scale > 0 ? node.lower[k] : node.upper[k];
    if (tightest && (row.scale > 0 ? value <= limit : value >= limit)) continue;
    if (tightest) tightest->binds = false;
    tightest = &row;
    row.binds = true;
    limit = value;
  }
}

/// Returns the gaps at a state of the node.
std::vector<double> gaps_at(std::span<const obstacle::Gap> gaps, const Vector3d& a3,
                            const Eigen::Matrix<double, 6, 1>& state) {
  const Vector3d u = state.head<3>(), r = geometry::tangential(state.tail<3>(), a3);
  std::vector<double> values;
  for (const obstacle::Gap& gap : gaps) values.push_back(gap(u, r));
  return values;
}

/// Returns the gaps in the order of their size.
std::vector<std::size_t> nearest_first(std::span<const double> gaps) {
  std::vector<std::size_t> order(gaps.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return gaps[k]; });
  return order;
}

/// Gives approximate bounds the gaps of the state: the other coordinates stay as they are there.
void keep_state(std::span<const double> gaps, std::span<const double> lifts, std::vector<ContactRow>& rows) {
  const auto at_state = [&](const ContactRow& row) {
    return gaps[static_cast<std::size_t>(row.obstacle)] - lifts[static_cast<std::size_t>(row.obstacle)];
  };
  for (ContactRow& row : rows) {
    if (!row.is_approximate) continue;
    const auto exact = std::ranges::find_if(
        rows, [&](const ContactRow& other) { return !other.is_approximate && other.coordinate == row.coordinate; });
    row.bound_gap = at_state(row) - row.scale * (at_state(*exact) - exact->bound_gap) / exact->scale;
  }
}

}  // namespace

NodeCoordinates node_coordinates(const NodalPoint& point, const NodeSupport& support,
                                 std::span<const obstacle::Gap> gaps, std::span<const double> lifts,
                                 const Eigen::Matrix<double, 6, 1>& at, double size) {
  PLASTRON_ASSERT(lifts.size() == gaps.size(), lifts.size(), gaps.size());
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const Split u = split(support.displacement, {}, point.x, {support.displacement_scale, rounding * size}),
              r = split(support.rotation, {point.a3.normalized()}, point.x, {support.rotation_scale, rounding});
  NodeCoordinates node;
  // Vertices of triangles of degree 2 have no weight in (M21), hence no bound.
  const auto counted = point.weight > 0 ? gaps : gaps.first(0);
  const std::vector<double> at_state = gaps_at(counted, point.a3, at);
  const ContactCoordinates contact = contact_coordinates(counted, nearest_first(at_state), u.free, r.free);
  prescribe(u, r, contact.columns, node);
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const auto place = k < contact.places.size() ? contact.places[k] : ContactPlace{};
    const double lift = place.coordinate >= 0 ? lifts[k] : 0;
    node.rows.push_back({.obstacle = static_cast<int>(k),
                         .coordinate = place.coordinate,
                         .scale = place.scale,
                         .bound_gap = point.weight > 0 ? gap_of_prescribed(gaps[k], u, r) - lift
                                                       : std::numeric_limits<double>::quiet_NaN(),
                         .is_left_out = place.is_left_out,
                         .is_approximate = place.is_approximate});
  }
  keep_state(at_state, lifts, node.rows);
  bound(node);
  const double most = support.rotation.empty() ? no_bound : 0;
  node.basis.col(5) << Vector3d::Zero(), point.a3;
  node.lower[5] = -most;
  node.upper[5] = most;
  return node;
}

void put_on_bed(std::optional<std::size_t> obstacle, const obstacle::Bed::Segment& segment, const NodalPoint& point,
                NodeCoordinates& node) {
  constexpr int surface = 5;
  node.basis.col(surface).setZero();
  node.lower[surface] = node.upper[surface] = 0;
  if (!obstacle) return;
  ContactRow& row = node.rows.at(*obstacle);
  if (!row.is_touchable()) {
    row.bound_gap = std::numeric_limits<double>::quiet_NaN();  // a bed lets the shell be held inside of it
    return;
  }
  row.bed = segment.stiffness * point.weight;
  row.segment = segment;
  row.bound_gap += segment.shift;
  row.gap_coordinate = std::exchange(row.coordinate, surface);
  row.gap_scale = std::exchange(row.scale, 1.0);
  for (ContactRow& other : node.rows) other.binds = false;
  const auto bounded = static_cast<std::size_t>(row.gap_coordinate);
  for (const std::size_t k : {bounded, static_cast<std::size_t>(surface)}) {
    node.lower[k] = -no_bound;
    node.upper[k] = no_bound;
  }
  bound(node);
}

}  // namespace plastron::assembly
