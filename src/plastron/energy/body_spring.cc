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
    const fem::BodyMotion q = motion(shell.space(), y);
    return (q.displacement.dot(stiffness_ * q.displacement) + q.rotation.dot(of_rotation_ * q.rotation)) / 2;
  }

  void add_forces(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& f) const override {
    const fem::BodyMotion q = motion(shell.space(), y);
    add(shell.space(), placed(shell.space(), y), {stiffness_ * q.displacement, couple(q.rotation)}, f);
  }

  void add_product(const ShellOperator& shell, const algebra::Vector& state, const algebra::Vector& v,
                   algebra::Vector& f) const override {
    const fem::PlacedBody body = placed(shell.space(), state);
    const fem::BodyMotion q = fem::fitted_motion(shell.space(), body, v);
    add(shell.space(), body, {stiffness_ * q.displacement, couple_rate(shell.space(), state) * q.rotation}, f);
  }

  std::optional<RowMatrix> stiffness(const ShellOperator& /*shell*/, std::size_t /*cell*/) const override { return {}; }

  std::optional<constraints::Matrix6> stiffness_of_body(const ShellOperator& shell, std::size_t body,
                                                        const algebra::Vector& state) const override {
    if (body != body_) return {};
    const double length = shell.space().bodies[body].length;
    constraints::Matrix6 k = constraints::Matrix6::Zero();
    k.topLeftCorner<3, 3>() = stiffness_;
    k.bottomRightCorner<3, 3>() = couple_rate(shell.space(), state) / (length * length);
    return k;
  }

 private:
  /// Returns the body at its place in the state, from which further motions are measured.
  fem::PlacedBody placed(const fem::Space& space, const algebra::Vector& y) const {
    const fem::PlacedBody& body = space.bodies[body_];
    return is_moved(y) ? fem::turned_body(body, fem::place_of(space, body, y)) : body;
  }

  bool is_moved(const algebra::Vector& y) const { return is_finite_ && y.layout(); }

  fem::BodyMotion motion(const fem::Space& space, const algebra::Vector& y) const {
    const fem::PlacedBody& body = space.bodies[body_];
    if (!is_finite_) return fem::fitted_motion(space, body, y);
    const fem::BodyPlace place = fem::place_of(space, body, y);
    return {place.displacement, geometry::rotation_vector(place.turn)};
  }

  /// Returns the derivative of the energy by a rotation that follows theta.
  Vector3d couple(const Vector3d& theta) const {
    const Vector3d own = of_rotation_ * theta;
    return is_finite_ ? Vector3d(transposed_change(theta) * own) : own;
  }

  /// Returns the second derivative of the energy by a rotation that follows that of the state.
  Matrix3d couple_rate(const fem::Space& space, const algebra::Vector& state) const {
    if (!is_moved(state) || of_rotation_.isZero(0)) return of_rotation_;
    constexpr double step = 1e-5;
    const Matrix3d turn = fem::place_of(space, space.bodies[body_], state).turn;
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
