#include <plastron/assembly/contact_coordinates.hpp>

#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace plastron::assembly {

namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

/// Part of a row below which its freedom, or its difference from another row, is ignored. Example: two plates squeeze a
/// curved shell. Both gaps depend on the rotation by the sine of the slope. Coordinates that separate the gaps would
/// lose digits by its square.
constexpr double negligible = 1e-6;

/// Returns directions of span(free) orthogonal to p, one fewer than `free` has.
std::vector<Vector3d> orthogonal_part(const std::vector<Vector3d>& free, const Vector3d& p) {
  if (free.size() == 3) {
    const auto pair = across(p.normalized());
    return {pair[0], pair[1]};
  }
  if (free.size() == 2) return {free[0].cross(free[1]).cross(p).normalized()};
  return {};
}

double change_of(const obstacle::Gap& gap, const ContactColumn& column) {
  return gap.normal.dot(column.u + gap.arm * column.r);
}

Vector3d projection(const std::vector<Vector3d>& onto, const Vector3d& v) {
  Vector3d p = Vector3d::Zero();
  for (const Vector3d& d : onto) p += d.dot(v) * d;
  return p;
}

/// Returns columns for one gap w: first the column that moves w, then the columns that do not change w. The first is a
/// displacement where u can move w. Where supports fix u in this direction, it is a rotation.
std::optional<std::vector<ContactColumn>> around_one_gap(const obstacle::Gap& gap, const std::vector<Vector3d>& u,
                                                         const std::vector<Vector3d>& r) {
  const Vector3d zero = Vector3d::Zero();
  std::vector<ContactColumn> columns;
  const Vector3d p = projection(u, gap.normal);
  if (p.norm() > negligible) {
    const Vector3d unit_w = p / p.squaredNorm();  // n . unit_w = 1
    columns.push_back({unit_w, zero});
    for (const Vector3d& d : orthogonal_part(u, p)) columns.push_back({d, zero});
    for (const Vector3d& d : r) columns.push_back({-gap.arm * gap.normal.dot(d) * unit_w, d});
    return columns;
  }
  const Vector3d q = projection(r, gap.normal);
  if (gap.arm == 0 || !(q.norm() > negligible)) return {};
  columns.push_back({zero, q / (gap.arm * q.squaredNorm())});
  for (const Vector3d& d : u) columns.push_back({d, zero});
  for (const Vector3d& d : orthogonal_part(r, q)) columns.push_back({zero, d});
  return columns;
}

/// The gaps as rows on the free directions: displacements are not scaled, rotations are multiplied by the largest arm.
struct GapRows {
  GapRows(std::span<const obstacle::Gap> gaps, const std::vector<Vector3d>& free_u, const std::vector<Vector3d>& free_r)
      : u(free_u),
        r(free_r),
        all(static_cast<Index>(gaps.size()), static_cast<Index>(u.size() + r.size())),
        arms(all.rows()) {
    for (const obstacle::Gap& gap : gaps) lever = std::max(lever, std::abs(gap.arm));
    if (lever == 0) lever = 1;  // no gap depends on r: the rows are zero there
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const auto row = static_cast<Index>(i);
      for (std::size_t k = 0; k < u.size(); ++k) all(row, static_cast<Index>(k)) = gaps[i].normal.dot(u[k]);
      for (std::size_t k = 0; k < r.size(); ++k)
        all(row, static_cast<Index>(u.size() + k)) = gaps[i].arm / lever * gaps[i].normal.dot(r[k]);
      arms[row] = gaps[i].arm;
    }
  }

  /// Projects row i on row k, and returns the factor of row k.
  double scale(Index i, Index k) const { return all.row(i).dot(all.row(k)) / all.row(k).squaredNorm(); }
  /// Returns the length of the part of row i that is orthogonal to row k.
  double difference(Index i, Index k) const { return (all.row(i) - scale(i, k) * all.row(k)).norm(); }

  ContactColumn column(const VectorXd& free) const {
    ContactColumn c;
    for (std::size_t k = 0; k < u.size(); ++k) c.u += free[static_cast<Index>(k)] * u[k];
    for (std::size_t k = 0; k < r.size(); ++k) c.r += free[static_cast<Index>(u.size() + k)] / lever * r[k];
    return c;
  }

  const std::vector<Vector3d>&u, &r;
  double lever = 0;
  MatrixXd all;
  VectorXd arms;
};

/// Returns a basis whose first columns C have F C = 1. They are orthogonal to the other columns, which F maps to zero.
MatrixXd dual_basis(const MatrixXd& F) {
  const auto qr = F.transpose().householderQr();
  MatrixXd basis = qr.householderQ();
  const MatrixXd R = qr.matrixQR().topRows(F.rows()).triangularView<Eigen::Upper>();
  // F' = Q R, so C = Q R^{-T}: no squares of F, whose rows may be nearly parallel.
  basis.leftCols(F.rows()) =
      R.triangularView<Eigen::Upper>().solve(basis.leftCols(F.rows()).transpose()).transpose().eval();
  return basis;
}

/// Returns columns: the first ones, C, have F C = 1, and F maps the others to zero. Where possible, displacements alone
/// move the gaps.
std::vector<ContactColumn> around_gaps(const GapRows& rows, const MatrixXd& F) {
  constexpr double well_apart = 0.05;  // least singular value of U
  const auto m = static_cast<Index>(rows.u.size()), p = F.rows();
  const MatrixXd U = F.leftCols(m);
  MatrixXd columns = MatrixXd::Zero(F.cols(), F.cols());
  if (p <= m && geometry::symmetric_eigen(MatrixXd(U * U.transpose())).values[0] > well_apart * well_apart) {
    columns.topLeftCorner(m, m) = dual_basis(U);
    for (Index k = m; k < F.cols(); ++k) {
      columns.block(0, k, m, 1) = -columns.topLeftCorner(m, p) * F.col(k);
      columns(k, k) = 1;
    }
  } else {
    columns = dual_basis(F);
  }
  std::vector<ContactColumn> result;
  result.reserve(static_cast<std::size_t>(columns.cols()));
  for (Index k = 0; k < columns.cols(); ++k) result.push_back(rows.column(columns.col(k)));
  return result;
}

/// Gaps that become coordinates, and the place of every gap.
struct Choice {
  std::vector<Index> coordinates{};
  std::vector<ContactPlace> places{};
};

/// Returns the place of a row that is parallel to a coordinate's row.
std::optional<ContactPlace> parallel_place(const GapRows& rows, Index row, const std::vector<Index>& coordinates) {
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (rows.difference(row, coordinates[k]) <= negligible * rows.all.row(row).norm())
      return ContactPlace{static_cast<int>(k), rows.scale(row, coordinates[k])};
  return {};
}

/// Whether the row is of the other face than the coordinate's row k, and its direction is nearly that of k or opposite to it.
/// The two gaps together change with the rotation alone, by the slope of the shell. Coordinates that separate them would be
/// rotations divided by the slope, and their stiffness would be divided by its square.
bool is_other_face(const GapRows& rows, Index row, Index k) {
  constexpr double nearly_parallel = 0.2;  // the obstacle's normal is within 6 degrees of the shell's
  return rows.arms[row] * rows.arms[k] < 0 && rows.difference(row, k) <= nearly_parallel * rows.all.row(row).norm();
}

/// Returns the coordinate of a gap on the other side of the shell: the two gaps cannot both close unless the shell is squeezed.
std::optional<ContactPlace> opposite_place(const GapRows& rows, Index row, const std::vector<Index>& coordinates) {
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (is_other_face(rows, row, coordinates[k]) && rows.scale(row, coordinates[k]) < 0)
      return ContactPlace{.coordinate = static_cast<int>(k), .is_approximate = true};
  return {};
}

/// Whether the row depends on the coordinates' rows. `rest` is its part that is orthogonal to all of them.
bool depends_on_several(const GapRows& rows, Index row, const std::vector<Index>& coordinates, double rest) {
  constexpr double noise = 1e-3;  // of directors and normals that lie in one plane
  double least = rows.all.row(row).norm();
  if (!(rest > negligible * least)) return true;
  for (const Index k : coordinates) least = std::min(least, rows.difference(row, k));
  return coordinates.size() > 1 && !(rest > noise * least);
}

Choice choose(const GapRows& rows, std::span<const std::size_t> order) {
  Choice choice;
  choice.places.resize(order.size());
  MatrixXd span(0, rows.all.cols());  // orthonormal rows
  for (const std::size_t next : order) {
    const auto i = static_cast<Index>(next);
    ContactPlace& place = choice.places[next];
    const Eigen::RowVectorXd row = rows.all.row(i);
    if (!(row.norm() > negligible)) continue;
    if (const auto parallel = parallel_place(rows, i, choice.coordinates)) {
      place = *parallel;
      continue;
    }
    if (const auto opposite = opposite_place(rows, i, choice.coordinates)) {
      place = *opposite;
      continue;
    }
    const Eigen::RowVectorXd rest = row - row * span.transpose() * span;
    place.is_left_out = depends_on_several(rows, i, choice.coordinates, rest.norm()) ||
                        std::ranges::any_of(choice.coordinates, [&](Index k) { return is_other_face(rows, i, k); });
    if (place.is_left_out) continue;
    span.conservativeResize(span.rows() + 1, Eigen::NoChange);
    span.bottomRows(1) = rest.normalized();
    place.coordinate = static_cast<int>(choice.coordinates.size());
    choice.coordinates.push_back(i);
  }
  return choice;
}

std::vector<ContactColumn> without_gaps(const std::vector<Vector3d>& u, const std::vector<Vector3d>& r) {
  std::vector<ContactColumn> columns;
  columns.reserve(u.size() + r.size());
  for (const Vector3d& d : u) columns.push_back({d, Vector3d::Zero()});
  for (const Vector3d& d : r) columns.push_back({Vector3d::Zero(), d});
  return columns;
}

}  // namespace

std::array<Vector3d, 2> across(const Vector3d& n) {
  int smallest = 0;
  n.cwiseAbs().minCoeff(&smallest);
  const Vector3d first = n.cross(Vector3d::Unit(smallest)).normalized();
  return {first, n.cross(first).normalized()};
}

ContactCoordinates contact_coordinates(std::span<const obstacle::Gap> gaps, std::span<const std::size_t> order,
                                       const std::vector<Vector3d>& u, const std::vector<Vector3d>& r) {
  ContactCoordinates result;
  if (gaps.size() == 1) {
    const auto columns = around_one_gap(gaps[0], u, r);
    return ContactCoordinates{columns ? *columns : without_gaps(u, r), {columns ? ContactPlace{0, 1} : ContactPlace{}}};
  }
  const GapRows rows(gaps, u, r);
  std::vector<std::size_t> as_given(gaps.size());
  std::iota(as_given.begin(), as_given.end(), 0);
  Choice choice = choose(rows, as_given);
  if (std::ranges::any_of(choice.places, [](const ContactPlace& p) { return p.is_left_out || p.is_approximate; }))
    choice = choose(rows, order);
  result.places = choice.places;
  if (choice.coordinates.empty()) {
    result.columns = without_gaps(u, r);
  } else {
    MatrixXd F(static_cast<Index>(choice.coordinates.size()), rows.all.cols());
    for (Index k = 0; k < F.rows(); ++k) F.row(k) = rows.all.row(choice.coordinates[static_cast<std::size_t>(k)]);
    result.columns = around_gaps(rows, F);
  }
  for (std::size_t i = 0; i < gaps.size(); ++i)
    if (ContactPlace& place = result.places[i]; place.is_approximate)
      place.scale = change_of(gaps[i], result.columns[static_cast<std::size_t>(place.coordinate)]);
  return result;
}

}  // namespace plastron::assembly
