#include <plastron/assembly/nodal_coordinates.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plastron::assembly {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

/// Orthonormal directions in R^3, those that are prescribed and those that are free.
struct Split {
  std::vector<Vector3d> prescribed;
  std::vector<double> values;
  std::vector<Vector3d> free;
};

/// Two unit vectors that make an orthonormal basis with the unit vector n.
std::array<Vector3d, 2> across(const Vector3d& n) {
  int smallest = 0;
  n.cwiseAbs().minCoeff(&smallest);
  const Vector3d first = n.cross(Vector3d::Unit(smallest)).normalized();
  return {first, n.cross(first)};
}

/// What one unknown's rows at a node are judged by.
struct Scales {
  double value;     ///< the largest value that the node's supports prescribe
  double rounding;  ///< rounding of a value that should be zero
};

/// Splits the plane or space orthogonal to `excluded` (empty: all of R^3) by the prescribed rows.
Split split(const std::vector<std::pair<Vector3d, double>>& rows, const std::vector<Vector3d>& excluded,
            const Vector2d& x, const Scales& scales) {
  // Directions that differ by less than this angle are one. Conormals of two boundaries that meet smoothly differ by
  // the rounding of the mesh's nodes, 1e-16 to 1e-7, and a component that is the quotient of two such differences
  // would be noise; beyond the angle a value's rounding is magnified by 1e4 at most.
  constexpr double negligible = 1e-4;
  constexpr double precision = 1e-9;
  Split result;
  std::vector<Vector3d> basis(excluded);
  for (const auto& [direction, value] : rows) {
    Vector3d d = direction;
    for (const Vector3d& q : excluded) d -= q.dot(d) * q;
    // What the directions taken so far already prescribe of this component:
    double known = 0;
    for (std::size_t k = 0; k < result.prescribed.size(); ++k) {
      const double share = result.prescribed[k].dot(d);
      known += share * result.values[k];
      d -= share * result.prescribed[k];
    }
    if (d.norm() > negligible) {
      result.values.push_back((value - known) / d.norm());
      result.prescribed.push_back(d.normalized());
      basis.push_back(result.prescribed.back());
    } else if (!(std::abs(value - known) <= (precision + d.norm()) * scales.value + scales.rounding)) {
      throw SupportError(
          fmt::format("supports contradict each other at x = {:g}, y = {:g}: a component that is already "
                      "prescribed as {:g} is to be {:g}",
                      x[0], x[1], known, value));
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

/// Directions of span(free) orthogonal to p, one fewer than free has.
std::vector<Vector3d> orthogonal_part(const std::vector<Vector3d>& free, const Vector3d& p) {
  if (free.size() == 3) {
    const auto pair = across(p.normalized());
    return {pair[0], pair[1]};
  }
  if (free.size() == 2) return {free[0].cross(free[1]).cross(p).normalized()};
  return {};
}

Vector3d projection(const std::vector<Vector3d>& onto, const Vector3d& v) {
  Vector3d p = Vector3d::Zero();
  for (const Vector3d& d : onto) p += d.dot(v) * d;
  return p;
}

/// Fills the columns of a node's basis from left to right.
class Columns {
 public:
  void add(const Vector3d& u, const Vector3d& r, double lower, double upper) {
    basis.col(next) << u, r;
    bounds[static_cast<std::size_t>(next++)] = {lower, upper};
  }
  NodeBasis basis = NodeBasis::Zero();
  std::array<std::pair<double, double>, 6> bounds{};

 private:
  int next = 0;
};

struct NodeResult {
  Columns columns;
  bool touchable = false;
  double bound_gap = std::numeric_limits<double>::quiet_NaN();
};

constexpr double infinity = std::numeric_limits<double>::infinity();

/// w first, then what leaves w alone. Returns false where w is prescribed by the supports.
bool add_contact_columns(const obstacle::Gap& gap, const Split& u, const Split& r, double bound_gap, Columns& columns) {
  constexpr double negligible = 1e-6;
  const Vector3d zero = Vector3d::Zero();
  const Vector3d p = projection(u.free, gap.normal);
  if (p.norm() > negligible) {
    const Vector3d unit_w = p / p.squaredNorm();  // n . unit_w = 1
    columns.add(unit_w, zero, -bound_gap, infinity);
    for (const Vector3d& d : orthogonal_part(u.free, p)) columns.add(d, zero, -infinity, infinity);
    for (const Vector3d& d : r.free) columns.add(-gap.z * gap.normal.dot(d) * unit_w, d, -infinity, infinity);
    return true;
  }
  const Vector3d q = projection(r.free, gap.normal);
  if (q.norm() > negligible) {
    columns.add(zero, q / (gap.z * q.squaredNorm()), -bound_gap, infinity);
    for (const Vector3d& d : u.free) columns.add(d, zero, -infinity, infinity);
    for (const Vector3d& d : orthogonal_part(r.free, q)) columns.add(zero, d, -infinity, infinity);
    return true;
  }
  return false;
}

/// `size`: of the shell [m].
NodeResult node_columns(const NodalPoint& point, const NodeSupport& support, const obstacle::Gap* gap, double size) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const Split u = split(support.displacement, {}, point.x, {support.displacement_scale, rounding * size}),
              r = split(support.rotation, {point.a3}, point.x, {support.rotation_scale, rounding});
  NodeResult node;
  if (gap) {
    node.bound_gap = gap->initial;
    for (std::size_t k = 0; k < u.prescribed.size(); ++k)
      node.bound_gap += gap->normal.dot(u.prescribed[k]) * u.values[k];
    for (std::size_t k = 0; k < r.prescribed.size(); ++k)
      node.bound_gap += gap->z * gap->normal.dot(r.prescribed[k]) * r.values[k];
    node.touchable = add_contact_columns(*gap, u, r, node.bound_gap, node.columns);
  }
  if (!node.touchable) {
    for (const Vector3d& d : u.free) node.columns.add(d, Vector3d::Zero(), -infinity, infinity);
    for (const Vector3d& d : r.free) node.columns.add(Vector3d::Zero(), d, -infinity, infinity);
  }
  for (std::size_t k = 0; k < u.prescribed.size(); ++k)
    node.columns.add(u.prescribed[k], Vector3d::Zero(), u.values[k], u.values[k]);
  for (std::size_t k = 0; k < r.prescribed.size(); ++k)
    node.columns.add(Vector3d::Zero(), r.prescribed[k], r.values[k], r.values[k]);
  const double most = support.rotation.empty() ? infinity : 0;
  node.columns.add(Vector3d::Zero(), point.a3, -most, most);
  return node;
}

constexpr int packed_size = 36 + 6 + 6 + 3;

void pack(const NodeResult& node, bool supported, double* out) {
  Eigen::Map<NodeBasis>{out} = node.columns.basis;
  for (std::size_t k = 0; k < 6; ++k) {
    out[36 + k] = node.columns.bounds[k].first;
    out[42 + k] = node.columns.bounds[k].second;
  }
  out[48] = node.touchable;
  out[49] = node.bound_gap;
  out[50] = supported;
}

/// The largest extent of the shell along an axis [m] (collective).
double extent(const std::vector<NodalPoint>& points, MPI_Comm comm) {
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    double low = infinity, high = -infinity;
    for (const NodalPoint& p : points) {
      low = std::min(low, p.phi[k]);
      high = std::max(high, p.phi[k]);
    }
    largest = std::max(largest, algebra::max_over_ranks(high, comm) - algebra::min_over_ranks(low, comm));
  }
  return largest;
}

}  // namespace

NodalCoordinates nodal_coordinates(const fem::Space& space, const fem::Surface& surface,
                                   const std::vector<NodalPoint>& points, const std::vector<Support>& supports,
                                   const GapFunction& gap, element::Formulation formulation) {
  const auto local = static_cast<std::size_t>(space.layout->local_size());
  const int width = element::is_relaxed(formulation) ? 6 : 5;
  NodalCoordinates coordinates{.width = width,
                               .basis = std::vector<NodeBasis>(local),
                               .supported = std::vector<char>(local),
                               .touchable = std::vector<char>(local),
                               .bound_gap = std::vector<double>(local),
                               .lower = algebra::Vector(space.layout, width),
                               .upper = algebra::Vector(space.layout, width),
                               .gaps = {}};
  // Owners decide, the others take over: a basis must be the same on every rank to the last bit.
  const auto node_support = node_supports(space, surface, points, supports);
  const double size = extent(points, space.layout->comm);
  algebra::Vector packed(space.layout, packed_size);
  algebra::in_agreement<SupportError>(space.layout->comm, [&] {
    if (gap)
      for (const NodalPoint& p : points) coordinates.gaps.push_back(gap(p.phi, p.a3, p.thickness));
    for (std::size_t i = 0; i < node_support.size(); ++i) {
      const NodeSupport& s = node_support[i];
      // Vertices of triangles of degree 2 carry no weight in (M21), hence no bound.
      pack(node_columns(points[i], s, gap && points[i].weight > 0 ? &coordinates.gaps[i] : nullptr, size),
           !s.displacement.empty() || !s.rotation.empty(), packed.local().data() + i * packed_size);
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
    coordinates.touchable[i] = in[48] != 0;
    coordinates.bound_gap[i] = in[49];
    coordinates.supported[i] = in[50] != 0;
  }
  return coordinates;
}

void NodalCoordinates::to_cartesian(const algebra::Vector& z, algebra::Vector& y) const {
  using Eigen::Map, Eigen::VectorXd;
  PLASTRON_ASSERT(z.block() == width && y.block() == 6 && z.local().size() == at(basis.size(), 0) &&
                      y.local().size() == 6 * basis.size(),
                  z.block(), width, y.block(), z.local().size(), y.local().size(), basis.size());
  for (std::size_t i = 0; i < basis.size(); ++i)
    Map<Eigen::Matrix<double, 6, 1>>(y.local().data() + 6 * i).noalias() =
        basis[i].leftCols(width) * Map<const VectorXd>(z.local().data() + at(i, 0), width);
}

void NodalCoordinates::add_transposed(const algebra::Vector& f, algebra::Vector& z) const {
  using Eigen::Map, Eigen::VectorXd;
  PLASTRON_ASSERT(
      z.block() == width && f.block() == 6 && f.owned().size() == 6 * static_cast<std::size_t>(z.layout()->owned),
      z.block(), width, f.block(), f.owned().size(), z.layout()->owned);
  const auto owned = static_cast<std::size_t>(z.layout()->owned);
  for (std::size_t i = 0; i < owned; ++i)
    Map<VectorXd>(z.local().data() + at(i, 0), width).noalias() +=
        basis[i].leftCols(width).transpose() * Map<const Eigen::Matrix<double, 6, 1>>(f.local().data() + 6 * i);
}

}  // namespace plastron::assembly
