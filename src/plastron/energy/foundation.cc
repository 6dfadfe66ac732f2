#include <plastron/energy/foundation.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/energy/body_spring.hpp>
#include <plastron/fem/cell_point.hpp>
#include <plastron/mesh/basis.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plastron::energy {

namespace {

using element::CellField;
using geometry::Vector3d;

/// K and G at a point, both times its area or length.
struct FoundationPoint {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  double shear = 0;
  double z = 0;

  bool is_nothing() const { return stiffness.isZero(0) && shear == 0; }
};

/// Points of a cell where a foundation acts.
struct FoundationPiece {
  std::size_t cell;
  std::optional<element::BasisAt> basis;  // nothing: the quadrature points of the cell
  std::vector<FoundationPoint> points;
};

class FoundationTerm final : public Term {
 public:
  explicit FoundationTerm(std::vector<FoundationPiece> pieces) : pieces_(std::move(pieces)) {
    std::ranges::stable_sort(pieces_, {}, &FoundationPiece::cell);
  }

  double energy(const ShellOperator& shell, const algebra::Vector& y) const override {
    double sum = 0;
    for (const FoundationPiece& piece : pieces_) {
      const CellField field = shell.gather(piece.cell, y);
      sum += field.cwiseProduct(forces(shell, piece, field)).sum() / 2;
    }
    return algebra::sum_over_ranks(sum, shell.space().layout->comm);
  }

  void add_forces(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& f) const override {
    for (const FoundationPiece& piece : pieces_)
      shell.scatter(piece.cell, forces(shell, piece, shell.gather(piece.cell, y)), f);
  }

  std::optional<RowMatrix> stiffness(const ShellOperator& shell, std::size_t cell) const override {
    const auto first = std::ranges::lower_bound(pieces_, cell, {}, &FoundationPiece::cell);
    const auto last = std::ranges::upper_bound(pieces_, cell, {}, &FoundationPiece::cell);
    if (first == last) return {};
    const auto size = 6 * static_cast<Eigen::Index>(shell.tables().nodes_per_cell());
    RowMatrix k = RowMatrix::Zero(size, size);
    CellField unit = CellField::Zero(size / 6, 6);
    for (Eigen::Index i = 0; i < size; ++i) {
      unit.data()[i] = 1;
      for (auto piece = first; piece != last; ++piece)
        k.row(i) += forces(shell, *piece, unit).reshaped<Eigen::RowMajor>().transpose();
      unit.data()[i] = 0;
    }
    return k;
  }

 private:
  static CellField forces(const ShellOperator& shell, const FoundationPiece& piece, const CellField& field) {
    const element::Interpolation& interpolation = shell.interpolation();
    const element::BasisAt& at = piece.basis ? *piece.basis : shell.tables().quadrature;
    const auto own_bases = piece.basis ? interpolation.bases(piece.cell, at.xi) : std::vector<geometry::MovingBasis>{};
    const auto bases = piece.basis ? element::Interpolation::Bases(own_bases) : shell.quadrature_bases(piece.cell);
    const element::FieldRows rows = interpolation.fields(piece.cell, at, bases, field);
    element::FieldRows dual = element::FieldRows::zero(rows.value.rows());
    for (Eigen::Index q = 0; q < rows.value.rows(); ++q) {
      const FoundationPoint& point = piece.points[static_cast<std::size_t>(q)];
      const auto at_height = [&](const CellField& part) {
        return Vector3d(part.row(q).head<3>() + point.z * part.row(q).tail<3>());
      };
      const auto add_at_height = [&](const Vector3d& force, CellField& part) {
        part.row(q).head<3>() += force;
        part.row(q).tail<3>() += point.z * force;
      };
      const Vector3d w = at_height(rows.value);
      Vector3d force = point.stiffness * w;
      if (point.shear > 0) {
        const geometry::Frame frame = shell.frame_at(piece.cell, static_cast<int>(q));
        const Eigen::Vector2d gradient(frame.a3.dot(at_height(rows.d1)) + frame.da3[0].dot(w),
                                       frame.a3.dot(at_height(rows.d2)) + frame.da3[1].dot(w));
        const Eigen::Vector2d raised = point.shear * (frame.metric_con * gradient);
        add_at_height(raised[0] * frame.a3, dual.d1);
        add_at_height(raised[1] * frame.a3, dual.d2);
        force += raised[0] * frame.da3[0] + raised[1] * frame.da3[1];
      }
      add_at_height(force, dual.value);
    }
    CellField result = CellField::Zero(field.rows(), 6);
    interpolation.add_forces(piece.cell, at, bases, std::move(dual), result);
    return result;
  }

  std::vector<FoundationPiece> pieces_;
};

/// Collects the pieces of a foundation on this rank.
class FoundationPieces {
 public:
  FoundationPieces(const ShellOperator& shell, const Foundation& foundation)
      : shell_(shell), space_(shell.space()), foundation_(foundation) {}

  void add_areas() {
    for (const std::string& region : foundation_.regions) index_of(region, space_.coarse->regions, "region");
    const std::vector<Eigen::Vector2d>& xi = shell_.tables().quadrature.xi;
    for (std::size_t c = 0; c < space_.owned_cells; ++c) {
      if (!foundation_.acts_in(region_of(*space_.coarse, space_.cells[c]))) continue;
      std::vector<geometry::Frame> frames;
      std::vector<double> areas;
      for (int q = 0; q < shell_.tables().points_per_cell(); ++q) {
        const QuadraturePoint point = shell_.point(c, q);
        frames.push_back(point.frame);
        areas.push_back(point.area);
      }
      add(c, xi, frames, areas, {});
    }
  }

  void add_sides() {
    const mesh::Rule line = mesh::gauss(space_.degree + 1);
    for (const std::string& boundary : foundation_.boundaries) {
      const auto index = static_cast<int>(index_of(boundary, space_.coarse->boundaries, "boundary"));
      for (const fem::BoundarySide& side : space_.sides) {
        if (side.boundary != index || side.cell >= space_.owned_cells) continue;
        std::vector<Eigen::Vector2d> xi;
        for (const double t : line.points) xi.push_back(mesh::side_point(space_.shape(), side.side, t));
        std::vector<geometry::Frame> frames(xi.size());
        shell_.surface().frames(space_.cells[side.cell], xi, frames, false);
        const Eigen::Vector2d along = mesh::side_tangent(space_.shape(), side.side);
        std::vector<double> lengths = line.weights;
        for (std::size_t q = 0; q < xi.size(); ++q) lengths[q] *= geometry::along(frames[q], along).norm();
        add(side.cell, xi, frames, lengths, element::basis_at(space_.shape(), space_.degree, xi));
      }
    }
  }

  /// `at`: fem::cell_point() of the spring.
  void add_point(const fem::CellPoint& at) {
    const std::vector<Eigen::Vector2d> xi{at.xi};
    std::vector<geometry::Frame> frames(1);
    shell_.surface().frames(space_.cells[at.cell], xi, frames, false);
    add(at.cell, xi, frames, {1.0}, element::basis_at(space_.shape(), space_.degree, xi));
  }

  /// Adds points of a cell with areas of 1. Only quadrature points were checked: elsewhere a negative stiffness counts as 0.
  void add_points(std::size_t cell, const std::vector<Eigen::Vector2d>& xi) {
    std::vector<geometry::Frame> frames(xi.size());
    shell_.surface().frames(space_.cells[cell], xi, frames, false);
    is_strict_ = false;
    add(cell, xi, frames, std::vector<double>(xi.size(), 1), {});
  }

  std::vector<FoundationPiece> take() { return std::move(pieces_); }

 private:
  std::string what() const {
    return foundation_.is_spring() ? fmt::format("the spring \"{}\"", foundation_.name)
                                   : fmt::format("the foundation \"{}\"", foundation_.name);
  }

  std::size_t index_of(const std::string& name, const std::vector<std::string>& known, const char* kind) const {
    const auto found = std::ranges::find(known, name);
    if (found == known.end())
      throw LoadError(fmt::format("{} names the {} \"{}\", which the mesh does not have; it has: {}", what(), kind,
                                  name, fmt::join(known, ", ")));
    return static_cast<std::size_t>(found - known.begin());
  }

  /// Returns the values of an expression, checked.
  std::vector<double> values(const geometry::Expression& f, const std::vector<geometry::Place>& places,
                             const char* name) const {
    std::vector<double> at_points(places.size());
    f.evaluate(places, at_points);
    if (!is_strict_) {
      for (double& k : at_points) k = std::isfinite(k) ? std::max(k, 0.0) : std::numeric_limits<double>::quiet_NaN();
      return at_points;
    }
    const auto bad = std::ranges::find_if(at_points, [](double k) { return !(k >= 0) || std::isinf(k); });
    if (bad == at_points.end()) return at_points;
    const geometry::Place& place = places[static_cast<std::size_t>(bad - at_points.begin())];
    throw LoadError(
        fmt::format("{} of {} is {:g} near x = {:.6g}, y = {:.6g}; a stiffness must be finite and not negative", name,
                    what(), *bad, place.x, place.y));
  }

  /// Adds the piece of a cell at points of these areas or lengths, unless it is soft everywhere.
  void add(std::size_t cell, const std::vector<Eigen::Vector2d>& xi, const std::vector<geometry::Frame>& frames,
           const std::vector<double>& areas, std::optional<element::BasisAt> basis) {
    const auto places = shell_.surface().places(space_.cells[cell], xi, true);
    const auto normal = values(foundation_.normal, places, "normal"),
               tangential = values(foundation_.tangential, places, "tangential"),
               shear = values(foundation_.shear, places, "shear");
    std::array<std::vector<double>, 3> along;
    for (std::size_t k = 0; k < 3; ++k) along[k] = values(foundation_.stiffness[k], places, "stiffness");
    std::vector<double> thickness(xi.size(), 0);
    if (foundation_.height != 0)
      shell_.surface().evaluate(shell_.section(cell).thickness, space_.cells[cell], xi, thickness);
    FoundationPiece piece{.cell = cell, .basis = std::move(basis), .points = {}};
    for (std::size_t q = 0; q < xi.size(); ++q) {
      const Eigen::Matrix3d along_normal = frames[q].a3 * frames[q].a3.transpose() / frames[q].a3.squaredNorm();
      Eigen::Matrix3d k = normal[q] * along_normal + tangential[q] * (Eigen::Matrix3d::Identity() - along_normal);
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d axis = foundation_.axes.row(static_cast<Eigen::Index>(i));
        k += along[i][q] * axis * axis.transpose();
      }
      piece.points.push_back(
          {.stiffness = areas[q] * k, .shear = areas[q] * shear[q], .z = foundation_.height * thickness[q]});
    }
    if (!std::ranges::all_of(piece.points, &FoundationPoint::is_nothing)) pieces_.push_back(std::move(piece));
  }

  const ShellOperator& shell_;
  const fem::Space& space_;
  const Foundation& foundation_;
  bool is_strict_ = true;
  std::vector<FoundationPiece> pieces_{};
};

/// Returns the term of a spring on a body; null if all its stiffnesses are 0. Throws LoadError if the space has no such body.
std::shared_ptr<const Term> spring_on_body(const fem::Space& space, const Foundation& spring,
                                           element::Rotations rotations) {
  const auto body = std::ranges::find(space.bodies, spring.body, [](const auto& placed) { return placed.body.name; });
  if (body == space.bodies.end())
    throw LoadError(
        fmt::format("the spring \"{}\" is on the rigid body \"{}\", which does not exist", spring.name, spring.body));
  const auto along_axes = [&](const VectorExpression& stiffnesses) {
    const Vector3d values(stiffnesses[0](0, 0), stiffnesses[1](0, 0), stiffnesses[2](0, 0));
    return Eigen::Matrix3d(spring.axes.transpose() * values.asDiagonal() * spring.axes);
  };
  const Eigen::Matrix3d stiffness = along_axes(spring.stiffness), of_rotation = along_axes(spring.rotation);
  if (stiffness.isZero(0) && of_rotation.isZero(0)) return nullptr;
  return body_spring(static_cast<std::size_t>(body - space.bodies.begin()), stiffness, of_rotation, rotations);
}

}  // namespace

std::shared_ptr<const Term> foundation_term(const ShellOperator& shell, const Foundation& foundation,
                                            element::Rotations rotations) {
  const fem::Space& space = shell.space();
  if (!foundation.body.empty()) return spring_on_body(space, foundation, rotations);
  const auto at = foundation.point ? fem::cell_point(space, *foundation.point) : std::nullopt;
  auto pieces = algebra::in_agreement<LoadError>(space.layout->comm, [&] {
    FoundationPieces all(shell, foundation);
    if (at)
      all.add_point(*at);
    else if (!foundation.boundaries.empty())
      all.add_sides();
    else if (!foundation.is_spring())
      all.add_areas();
    return all.take();
  });
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(pieces.size()), space.layout->comm) == 0) return nullptr;
  return std::make_shared<const FoundationTerm>(std::move(pieces));
}

std::vector<Eigen::Vector3d> tractions(const ShellOperator& shell, const Foundation& foundation, std::size_t cell,
                                       const std::vector<Vector2d>& xi, const CellField& values) {
  std::vector<Eigen::Vector3d> all(xi.size(), Eigen::Vector3d::Zero());
  if (!foundation.acts_in(region_of(*shell.space().coarse, shell.space().cells[cell]))) return all;
  FoundationPieces pieces(shell, foundation);
  pieces.add_points(cell, xi);
  for (const FoundationPiece& piece : pieces.take())
    for (std::size_t p = 0; p < all.size(); ++p) {
      const auto row = values.row(static_cast<Eigen::Index>(p));
      all[p] -= piece.points[p].stiffness * (row.head<3>() + piece.points[p].z * row.tail<3>()).transpose();
    }
  return all;
}

}  // namespace plastron::energy
