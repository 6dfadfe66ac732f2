#include <plastron/energy/hinge.hpp>

#include <plastron/element/element_tables.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <utility>

namespace plastron::energy {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Adds the derivatives of sign times the angle of d about a. It has no value of its own: only differences of two angles have one.
/// The part of its second derivative by a that is not symmetric does not depend on d, and is left out.
void add_side(const Vector3d& a, const Vector3d& d, double sign, Eigen::Index place, HingeAngle& angle) {
  const Vector3d p = a.cross(d), q = p.cross(a);
  const double length = a.norm(), n = p.squaredNorm(), c = a.dot(d), cubed = length * length * length;
  const Matrix3d turning = p * q.transpose() + q * p.transpose(), tilting = a * p.transpose() + p * a.transpose();
  angle.gradient.segment<3>(place) += sign * length / n * p;
  angle.gradient.head<3>() -= sign * c / (length * n) * p;
  const Matrix3d mixed = sign * (c / (length * n * n) * turning - p * a.transpose() / (length * n));  // by a and d
  angle.hessian.block<3, 3>(place, place) -= sign * length / (n * n) * turning;
  angle.hessian.block<3, 3>(0, place) += mixed;
  angle.hessian.block<3, 3>(place, 0) += mixed.transpose();
  angle.hessian.topLeftCorner<3, 3>() +=
      sign / (cubed * n) * (c * tilting - 0.5 * turning) - sign * c * c / (cubed * n * n) * turning;
}

/// A node of the edge.
struct HingePoint {
  double stiffness;   // times weight and length
  Vector9 reference;  // a, d_1, d_2
  double rest;        // the angle there
  Vector9 slope;      // its derivative there
};

/// A side of a cell. `nodes`: Space::nodes() of the hinge; `along`: derivatives of the nodes' functions, a row for each point.
struct HingePiece {
  std::vector<algebra::LocalIndex> nodes;
  Eigen::MatrixXd along;
  std::vector<HingePoint> points;

  std::size_t partner(std::size_t point) const { return node(points.size() + point); }
  std::size_t node(std::size_t i) const { return static_cast<std::size_t>(nodes[i]); }
};

Eigen::Map<const Vector3d> part_of(const algebra::Vector& y, std::size_t node, std::size_t first) {
  return Eigen::Map<const Vector3d>(y.local().data() + 6 * node + first);
}

/// Returns (a, d_1, d_2) of nodal values (y, d).
Vector9 vectors_at(const HingePiece& piece, std::size_t point, std::size_t points, const algebra::Vector& y) {
  Vector9 x = Vector9::Zero();
  for (std::size_t j = 0; j < points; ++j)
    x.head<3>() +=
        piece.along(static_cast<Eigen::Index>(point), static_cast<Eigen::Index>(j)) * part_of(y, piece.node(j), 0);
  x.segment<3>(3) = part_of(y, piece.node(points + point), 3);
  x.tail<3>() = part_of(y, piece.node(point), 3);
  return x;
}

Vector9 motion_at(const HingePiece& piece, std::size_t point, const algebra::Vector& y) {
  return vectors_at(piece, point, piece.points.size(), y);
}

void add_forces_at(const HingePiece& piece, std::size_t point, const Vector9& forces, algebra::Vector& f) {
  const auto part = [&](std::size_t node, std::size_t first) {
    return Eigen::Map<Vector3d>(f.local().data() + 6 * node + first);
  };
  for (std::size_t j = 0; j < piece.points.size(); ++j)
    part(piece.node(j), 0) +=
        piece.along(static_cast<Eigen::Index>(point), static_cast<Eigen::Index>(j)) * forces.head<3>();
  part(piece.partner(point), 3) += forces.segment<3>(3);
  part(piece.node(point), 3) += forces.tail<3>();
}

class HingeTerm final : public Term {
 public:
  HingeTerm(std::vector<HingePiece> pieces, bool is_finite) : pieces_(std::move(pieces)), is_finite_(is_finite) {}

  double energy(const ShellOperator& shell, const algebra::Vector& y) const override {
    double sum = 0;
    for_points([&](const HingePiece& piece, std::size_t i) {
      const double turn = at(piece.points[i], motion_at(piece, i, y)).value;
      sum += piece.points[i].stiffness * turn * turn / 2;
    });
    return algebra::sum_over_ranks(sum, shell.space().layout->comm);
  }

  void add_forces(const ShellOperator& /*shell*/, const algebra::Vector& y, algebra::Vector& f) const override {
    for_points([&](const HingePiece& piece, std::size_t i) {
      const HingeAngle turn = at(piece.points[i], motion_at(piece, i, y));
      add_forces_at(piece, i, piece.points[i].stiffness * turn.value * turn.gradient, f);
    });
  }

  void add_product(const ShellOperator& /*shell*/, const algebra::Vector& state, const algebra::Vector& motion,
                   algebra::Vector& f) const override {
    for_points([&](const HingePiece& piece, std::size_t i) {
      add_forces_at(piece, i, second_derivative(piece, i, state) * motion_at(piece, i, motion), f);
    });
  }

  std::optional<RowMatrix> stiffness(const ShellOperator& /*shell*/, std::size_t /*cell*/) const override { return {}; }

  std::vector<constraints::NodeColumns> stiffness_between_cells(const ShellOperator& /*shell*/,
                                                                const algebra::Vector& state) const override {
    std::vector<constraints::NodeColumns> all;
    for (const HingePiece& piece : pieces_) {
      const auto size = static_cast<Eigen::Index>(6 * piece.nodes.size());
      RowMatrix sum = RowMatrix::Zero(size, size);
      for (std::size_t i = 0; i < piece.points.size(); ++i) {
        RowMatrix b = RowMatrix::Zero(9, size);
        const auto put = [&](Eigen::Index row, std::size_t column, double factor) {
          b.block<3, 3>(row, static_cast<Eigen::Index>(column)).diagonal().setConstant(factor);
        };
        for (std::size_t j = 0; j < piece.points.size(); ++j)
          put(0, 6 * j, piece.along(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
        put(3, 6 * (piece.points.size() + i) + 3, 1);
        put(6, 6 * i + 3, 1);
        sum += b.transpose() * second_derivative(piece, i, state) * b;
      }
      all.push_back({.nodes = piece.nodes, .matrix = std::move(sum)});
    }
    return all;
  }

 private:
  template <class Visit>
  void for_points(const Visit& visit) const {
    for (const HingePiece& piece : pieces_)
      for (std::size_t i = 0; i < piece.points.size(); ++i) visit(piece, i);
  }

  /// Returns the change of the angle, with its derivatives.
  HingeAngle at(const HingePoint& point, const Vector9& motion) const {
    if (!is_finite_) return {point.slope.dot(motion), point.slope, Matrix9::Zero()};
    HingeAngle angle = hinge_angle(point.reference + motion);
    angle.value = std::remainder(angle.value - point.rest, 2 * std::numbers::pi);
    return angle;
  }

  Matrix9 second_derivative(const HingePiece& piece, std::size_t i, const algebra::Vector& state) const {
    const HingePoint& point = piece.points[i];
    const bool reads_state = is_finite_ && state.layout();
    const HingeAngle angle = at(point, reads_state ? motion_at(piece, i, state) : Vector9(Vector9::Zero()));
    return point.stiffness * (angle.gradient * angle.gradient.transpose() + angle.value * angle.hessian);
  }

  std::vector<HingePiece> pieces_;
  bool is_finite_;
};

HingePiece piece_of(const fem::Space& space, const fem::HingeSide& hinge, const algebra::Vector& reference) {
  const mesh::Rule line = mesh::gauss_lobatto(space.degree + 1);
  std::vector<Eigen::Vector2d> xi;
  for (const double t : line.points) xi.push_back(mesh::side_point(space.shape(), hinge.side, t));
  const element::BasisAt basis = element::basis_at(space.shape(), space.degree, xi);
  const Eigen::Vector2d tangent = mesh::side_tangent(space.shape(), hinge.side);
  const Eigen::MatrixXd derivatives = tangent[0] * basis.d1 + tangent[1] * basis.d2;
  HingePiece piece{.nodes = space.nodes(hinge),
                   .along = derivatives(Eigen::all, mesh::side_nodes(space.shape(), space.degree, hinge.side)),
                   .points = {}};
  for (std::size_t i = 0; i < xi.size(); ++i) {
    const Vector9 at = vectors_at(piece, i, xi.size(), reference);
    const HingeAngle angle = hinge_angle(at);
    piece.points.push_back({.stiffness = hinge.stiffness * line.weights[i] * at.head<3>().norm(),
                            .reference = at,
                            .rest = angle.value,
                            .slope = angle.gradient});
  }
  return piece;
}

}  // namespace

HingeAngle hinge_angle(const Vector9& vectors) {
  const Vector3d a = vectors.head<3>(), first = vectors.segment<3>(3), second = vectors.tail<3>();
  HingeAngle angle{.value = std::atan2(a.norm() * a.dot(first.cross(second)), a.cross(first).dot(a.cross(second))),
                   .gradient = Vector9::Zero(),
                   .hessian = Matrix9::Zero()};
  add_side(a, first, -1, 3, angle);
  add_side(a, second, 1, 6, angle);
  return angle;
}

std::shared_ptr<const Term> hinge_term(const fem::Space& space, const algebra::Vector& reference,
                                       element::Rotations rotations) {
  std::vector<HingePiece> pieces;
  pieces.reserve(space.hinges.size());
  for (const fem::HingeSide& hinge : space.hinges) pieces.push_back(piece_of(space, hinge, reference));
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(pieces.size()), space.layout->comm) == 0) return nullptr;
  return std::make_shared<const HingeTerm>(std::move(pieces), rotations == element::Rotations::finite);
}

}  // namespace plastron::energy
