#include <plastron/energy/body_spring.hpp>

#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/rotation.hpp>

#include <Eigen/Core>

#include <cmath>
#include <utility>

namespace plastron::energy {

namespace {

using Eigen::Matrix3d;
using geometry::Vector3d;

/// Returns J' with J w the change of a rotation vector theta when the rotation w follows it.
Matrix3d transposed_change(const Vector3d& theta) {
  constexpr double small = 1e-3;
  const double angle = theta.norm();
  const double c = angle < small ? 1.0 / 12 + angle * angle / 720
                                 : (1 - angle * std::sin(angle) / (2 * (1 - std::cos(angle)))) / (angle * angle);
  const Matrix3d cross = geometry::cross_matrix(theta);
  return Matrix3d::Identity() + cross / 2 + c * cross * cross;
}

/// The part of a body's motion that springs resist: (d, theta) with small rotations, else the displacement and the rotation vector.
class BodySpring final : public Term {
 public:
  BodySpring(std::size_t body, Matrix3d stiffness, Matrix3d of_rotation, element::Rotations rotations)
      : body_(body),
        stiffness_(std::move(stiffness)),
        of_rotation_(std::move(of_rotation)),
        is_finite_(rotations == element::Rotations::finite) {}

  bool is_on_body() const override { return true; }

  double energy(const ShellOperator& shell, const algebra::Vector& y) const override {
    const fem::BodyMotion q = motion(shell.space(), placed(shell.space(), y), y);
    return (q.displacement.dot(stiffness_ * q.displacement) + q.rotation.dot(of_rotation_ * q.rotation)) / 2;
  }

  void add_forces(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& f) const override {
    const Placed at = placed(shell.space(), y);
    const fem::BodyMotion q = motion(shell.space(), at, y);
    add(shell.space(), at.body, {stiffness_ * q.displacement, couple(q.rotation)}, f);
  }

  void add_product(const ShellOperator& shell, const algebra::Vector& state, const algebra::Vector& v,
                   algebra::Vector& f) const override {
    const Placed at = placed(shell.space(), state);
    const fem::BodyMotion q = fem::fitted_motion(shell.space(), at.body, v);
    add(shell.space(), at.body, {stiffness_ * q.displacement, couple_rate(at.place.turn) * q.rotation}, f);
  }

  std::optional<RowMatrix> stiffness(const ShellOperator& /*shell*/, std::size_t /*cell*/) const override { return {}; }

  std::optional<constraints::Matrix6> stiffness_of_body(const ShellOperator& shell, std::size_t body,
                                                        const algebra::Vector& state) const override {
    if (body != body_) return {};
    const double length = shell.space().bodies[body].length;
    constraints::Matrix6 k = constraints::Matrix6::Zero();
    k.topLeftCorner<3, 3>() = stiffness_;
    k.bottomRightCorner<3, 3>() = couple_rate(place_in(shell.space(), state).turn) / (length * length);
    return k;
  }

 private:
  struct Placed {
    fem::BodyPlace place;
    fem::PlacedBody body;  // there: further motions are measured from it
  };

  /// Returns the place of the body in a state; that of the reference with small rotations.
  fem::BodyPlace place_in(const fem::Space& space, const algebra::Vector& y) const {
    return is_finite_ && y.layout() ? fem::place_of(space, space.bodies[body_], y) : fem::BodyPlace{};
  }

  Placed placed(const fem::Space& space, const algebra::Vector& y) const {
    const fem::BodyPlace place = place_in(space, y);
    return {place, is_finite_ ? fem::turned_body(space.bodies[body_], place) : space.bodies[body_]};
  }

  fem::BodyMotion motion(const fem::Space& space, const Placed& at, const algebra::Vector& y) const {
    if (!is_finite_) return fem::fitted_motion(space, at.body, y);
    return {at.place.displacement, geometry::rotation_vector(at.place.turn)};
  }

  /// Returns the derivative of the energy by a rotation that follows theta.
  Vector3d couple(const Vector3d& theta) const {
    const Vector3d own = of_rotation_ * theta;
    return is_finite_ ? Vector3d(transposed_change(theta) * own) : own;
  }

  /// Returns the second derivative of the energy by a rotation that follows `turn`.
  Matrix3d couple_rate(const Matrix3d& turn) const {
    if (turn.isIdentity(0) || of_rotation_.isZero(0)) return of_rotation_;
    constexpr double step = 1e-5;
    Matrix3d rate;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto after = [&](double angle) {
        return couple(geometry::rotation_vector(geometry::rotation_of(angle * Vector3d::Unit(k)) * turn));
      };
      rate.col(k) = (after(step) - after(-step)) / (2 * step);
    }
    return (rate + rate.transpose()) / 2;
  }

  /// Adds nodal forces with the work of a force and a couple in the body's motions about its place.
  static void add(const fem::Space& space, fem::PlacedBody body, const fem::BodyMotion& forces, algebra::Vector& f) {
    body.body.force = forces.displacement;
    body.body.moment = forces.rotation;
    fem::add_body_load(space, body, f);
  }

  std::size_t body_;
  Matrix3d stiffness_, of_rotation_;
  bool is_finite_;
};

}  // namespace

std::shared_ptr<const Term> body_spring(std::size_t body, const Matrix3d& stiffness, const Matrix3d& of_rotation,
                                        element::Rotations rotations) {
  return std::make_shared<const BodySpring>(body, stiffness, of_rotation, rotations);
}

}  // namespace plastron::energy
