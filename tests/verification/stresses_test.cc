// Stresses of closed forms at the lower face, the middle and the upper face, and resultants over a cut against the load.
#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plastron {
namespace {

computation::Result solved(const std::string& text) {
  return computation::solve(config::parse_case(text, "stresses.toml").problem, MPI_COMM_WORLD);
}

std::string shell_of(double nu, double thickness) {
  return fmt::format("[shell]\nE = 1.0\nnu = {}\nthickness = {}\n", nu, thickness);
}

const recovery::PointValues& probe_of(const computation::Result& result, const std::string& name) {
  for (const computation::ProbeValue& p : result.probes)
    if (p.name == name) return p.values;
  throw std::invalid_argument(name);
}

/// sigma at both faces and in the middle, in separate rows.
std::array<Eigen::Vector3d, 3> stresses(const recovery::PointValues& p) {
  const auto f = recovery::section_forces(p);
  return {shell::in_plane_stress(f, -p.thickness / 2), shell::in_plane_stress(f, 0),
          shell::in_plane_stress(f, p.thickness / 2)};
}

void expect_stresses(const recovery::PointValues& p, const std::array<Eigen::Vector3d, 3>& wanted, double tolerance) {
  double size = 0;
  for (const auto& s : wanted) size = std::max(size, s.norm());
  const auto found = stresses(p);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT((found[k] - wanted[k]).norm(), tolerance * size)
        << "height " << k << ": " << found[k].transpose() << " instead of " << wanted[k].transpose();
}

// M_r = q (a^2 (1 + nu) - r^2 (3 + nu)) / 16, M_t = q (a^2 (1 + nu) - r^2 (1 + 3 nu)) / 16, whatever the shear stiffness: the rotation
// of the normal obeys one equation with the statically given Q = -q r / 2. Timoshenko and Woinowsky-Krieger, section 16.
TEST(Stresses, OfAClampedCircularPlateAreThoseOfTheClosedForm) {
  const double q = 1e-4, nu = 0.3, e = 0.05;
  std::string text = shell_of(nu, e) + fmt::format(R"case([geometry]
domain = {{ disk = {{ radius = 1 }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 2
[output]
axis = [1, 0, 0]
[[support]]
boundary = "rim"
fix = ["u", "r"]
[[load]]
force = [0, 0, {}]
)case",
                                                   q);
  for (const double r : {0.0, 0.3, 0.7, 1.0}) text += fmt::format("[[probe]]\nname = \"{}\"\nat = [{}, 0]\n", r, r);
  const auto result = solved(text);
  for (const double r : {0.0, 0.3, 0.7, 1.0}) {
    // A force along +z stretches the upper face in the middle.
    const double radial = q * (1 + nu - r * r * (3 + nu)) / 16, hoop = q * (1 + nu - r * r * (1 + 3 * nu)) / 16;
    const Eigen::Vector3d face = 6 / (e * e) * Eigen::Vector3d(radial, hoop, 0);
    expect_stresses(probe_of(result, fmt::format("{}", r)), {-face, Eigen::Vector3d::Zero(), face}, 1e-4);
  }
  EXPECT_NEAR(probe_of(result, "0.7").Q[0], -q * 0.7 / 2, 1e-4 * q);
  // Clamped: the largest strain is at the rim, 6 M_r / e^2, with nu times that along it.
  const double rim = 6 / (e * e) * q / 8;
  EXPECT_NEAR(result.peak.von_mises, rim * std::sqrt(1 - nu + nu * nu), 2e-4 * rim);
  EXPECT_NEAR(result.peak.x.norm(), 1, 1e-12);
  EXPECT_NEAR(std::abs(result.peak.height), e / 2, 1e-12);
}

// A sphere that grows by w: gamma = w/R, chi = w/R^2 of the metric, so N = e E/(1-nu) w/R and M = e^3/12 E/(1-nu) w/R^2, in equilibrium with the
// pressure 2 N/R + 2 M/R^2. The rim of the cap is moved as the sphere moves there.
TEST(Stresses, OfASphereUnderPressureAreThoseOfTheMembraneAndTheWallsOwn) {
  const double w = 1e-3, nu = 0.25, e = 0.1, N = e / (1 - nu) * w, M = e * e * e / 12 / (1 - nu) * w;
  const auto result = solved(shell_of(nu, e) + fmt::format(R"case([geometry]
domain = {{ disk = {{ radius = 0.6 }} }}
chart = ["x", "y", "sqrt(1 - x^2 - y^2)"]
[mesh]
degree = 4
refinements = 2
[[support]]
boundary = "rim"
fix = ["u", "r"]
values = {{ u = ["{}*x", "{}*y", "{}*sqrt(1-x^2-y^2)"] }}
[[load]]
pressure = {}
[[probe]]
name = "top"
at = [0, 0]
[[probe]]
name = "side"
at = [0.2, 0.4]
[[probe]]
name = "rim"
at = [0, -0.6]
)case",
                                                           w, w, w, 2 * N + 2 * M));
  const Eigen::Vector3d both(1, 1, 0);
  for (const char* name : {"top", "side", "rim"}) {
    const auto& p = probe_of(result, name);
    const double face = 6 * M / (e * e);
    expect_stresses(p, {(N / e - face) * both, N / e * both, (N / e + face) * both}, 1e-4);
    EXPECT_NEAR(p.curvatures[0], -1, 1e-12);
    EXPECT_NEAR(p.curvatures[1], -1, 1e-12);
  }
}

// A tube between walls that let it grow by w but not get longer: N_t = e E/(1-nu^2) w/R, M_t = e^3/12 E/(1-nu^2) w/R^2, nu times these
// along the axis, in equilibrium with the pressure N_t/R + M_t/R^2.
TEST(Stresses, OfATubeUnderPressureDoNotDependOnTheSeam) {
  const double nu = 0.3, e = 0.05, w = 2e-3, N = e / (1 - nu * nu) * w, M = e * e * e / 12 / (1 - nu * nu) * w;
  const auto result = solved(shell_of(nu, e) + fmt::format(R"case([geometry]
domain = {{ rectangle = {{ from = [0, 0], to = ["2*pi", 1], cells = [8, 2] }} }}
chart = ["cos(x)", "sin(x)", "y"]
[mesh]
degree = 3
refinements = 2
[output]
axis = [0, 0, 1]
[[join]]
boundaries = ["left", "right"]
[[support]]
boundary = ["bottom", "top"]
fix = ["symmetry"]
[[support]]
point = [0, 0]
fix = ["u.y"]
[[support]]
point = ["pi/2", 0]
fix = ["u.x"]
[[support]]
point = ["pi", 0]
fix = ["u.y"]
[[load]]
pressure = {}
[[probe]]
name = "front"
at = [1, 0.5]
[[probe]]
name = "seam"
at = [0, 0.5]
)case",
                                                           N + M));
  for (const char* name : {"front", "seam"}) {
    const auto& p = probe_of(result, name);
    const Eigen::Vector3d along(nu, 1, 0);  // t1 is the axis
    const double face = 6 * M / (e * e);
    expect_stresses(p, {(N / e - face) * along, N / e * along, (N / e + face) * along}, 1e-4);
  }
}

// A strip bent by couples m per length at its free end: M_11 = m, nothing else, to rounding.
TEST(Stresses, OfAStripInPureBendingAreExact) {
  const double m = 1e-5, e = 0.02;
  for (const char* cells : {"quadrilateral", "triangle"}) {
    const auto result = solved(shell_of(0, e) + fmt::format(R"case([geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 0.2] }} }}
chart = ["x", "y", "0"]
[mesh]
cells = "{}"
degree = 2
refinements = 2
[[support]]
boundary = "left"
fix = ["u", "r"]
[[load]]
boundary = "right"
couple = [{}, 0, 0]
[[probe]]
name = "middle"
at = [0.5, 0.1]
[[probe]]
name = "corner"
at = [1, 0.2]
)case",
                                                            cells, m));
    const Eigen::Vector3d face(6 * m / (e * e), 0, 0);
    for (const char* name : {"middle", "corner"})
      expect_stresses(probe_of(result, name), {-face, Eigen::Vector3d::Zero(), face}, 1e-8);
    EXPECT_NEAR(result.peak.von_mises, face[0], 1e-8 * face[0]);
  }
}

/// Force through the ring r = const of a cap round its axis, from N and Q at points of the ring.
double vertical_force(const computation::Result& result, double radius, int points) {
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / points;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  double force = 0;
  for (const auto& p : computation::values_at(*result.solution, ring, "the ring")) {
    const Eigen::Vector3d tangent(-p.x[1] / radius, p.x[0] / radius, 0),
        normal = tangent.cross(p.a3);  // outward, in the surface
    const double n1 = normal.dot(p.t1), n2 = normal.dot(p.t2);
    const Eigen::Vector3d traction =
        (p.N[0] * n1 + p.N[2] * n2) * p.t1 + (p.N[2] * n1 + p.N[1] * n2) * p.t2 + (p.Q[0] * n1 + p.Q[1] * n2) * p.a3;
    force += traction[2] * 2 * std::numbers::pi * radius / points;
  }
  return force;
}

// The shear forces of a plate on a circle carry the load inside.
TEST(Stresses, OverACutBalanceTheLoadInside) {
  std::array<double, 2> errors{};
  for (int level = 0; level < 2; ++level) {
    const auto result = solved(shell_of(0.3, 0.02) + fmt::format(R"case([geometry]
domain = {{ disk = {{ radius = 1 }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 2
refinements = {}
[[support]]
boundary = "rim"
fix = ["u", "r"]
[[load]]
force = [0, 0, "1e-5*(1 + x^2 + y^2)"]
)case",
                                                                 3 + level));
    const double inside = 1e-5 * std::numbers::pi * (0.25 + 0.25 * 0.25 / 2);
    errors[static_cast<std::size_t>(level)] = std::abs(vertical_force(result, 0.5, 200) + inside) / inside;
  }
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 2.5);  // one order above that of Q in a cell
}

}  // namespace
}  // namespace plastron
