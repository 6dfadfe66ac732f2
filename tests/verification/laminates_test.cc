// Orthotropic and layered shells against closed forms: plates of Navier and Lekhnitskii, the bimetal strip, tubes, and
// contact against a one-dimensional solution.
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace plastron {
namespace {

constexpr double pi = std::numbers::pi;

computation::Result solved(const std::string& text) {
  return computation::solve(config::parse_case(text, "laminate.toml").problem, MPI_COMM_WORLD);
}

/// Layers of one material with E1 = 25, E2 = 1, as in Reddy's tables.
std::string carbon_layers(const std::vector<double>& degrees, const std::string& direction = "[1, 0, 0]") {
  std::string text = R"case([[material]]
name = "carbon"
E1 = 25
E2 = 1
nu12 = 0.25
G12 = 0.5
G13 = 0.5
G23 = 0.2
[[material]]
name = "stack"
)case";
  text += "direction = " + direction + "\n";
  for (const double angle : degrees)
    text += fmt::format("[[material.layers]]\nmaterial = \"carbon\"\nthickness = 1\nangle = {}\n", angle);
  return text;
}

struct Stiffness {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = A, D = A;
  Eigen::Vector2d S = Eigen::Vector2d::Zero();
};

/// Shear stiffness along the direction in which layers have the stiffness Q11 and the modulus G, for Q_1 alone and a law without
/// shear coupling: the energy of the stresses that balance d_1 sigma_11. `strains`: gamma, chi for d_1 M_11 = 1.
double shear_stiffness(const std::vector<Eigen::Vector3d>& rows, const std::vector<double>& moduli,
                       const Eigen::Matrix<double, 6, 1>& strains, double h) {
  const double height = h / static_cast<double>(rows.size());
  constexpr int intervals = 200;  // Simpson's rule in each layer
  double compliance = 0, below = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double low = -h / 2 + static_cast<double>(k) * height;
    const auto stress = [&](double z) {
      return below - rows[k].dot(strains.head<3>() * (z - low) + strains.tail<3>() * (z * z - low * low) / 2);
    };
    for (int i = 0; i <= intervals; ++i) {
      const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2;
      compliance += weight * height / (3 * intervals) * std::pow(stress(low + height * i / intervals), 2) / moduli[k];
    }
    below = stress(low + height);
  }
  return 1 / compliance;
}

/// The stiffness of carbon_layers() by textbook formulas: invariants of the turned plane-stress law. The shear stiffness is that
/// of a cross-ply; its axes are those of the layers, also for [45/-45].
Stiffness textbook(const std::vector<double>& degrees, double h, double k_s) {
  const double common = 1 - 0.25 * 0.25 / 25, Q11 = 25 / common, Q22 = 1 / common, Q12 = 0.25 / common, Q66 = 0.5;
  Stiffness s;
  std::vector<Eigen::Vector3d> rows1, rows2;  // of each layer, along the first and the second axis
  std::vector<double> G1, G2;
  const double height = h / static_cast<double>(degrees.size());
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    const double c = std::cos(degrees[k] * pi / 180), n = std::sin(degrees[k] * pi / 180);
    Eigen::Matrix3d q;
    q(0, 0) = Q11 * std::pow(c, 4) + 2 * (Q12 + 2 * Q66) * c * c * n * n + Q22 * std::pow(n, 4);
    q(1, 1) = Q11 * std::pow(n, 4) + 2 * (Q12 + 2 * Q66) * c * c * n * n + Q22 * std::pow(c, 4);
    q(0, 1) = (Q11 + Q22 - 4 * Q66) * c * c * n * n + Q12 * (std::pow(c, 4) + std::pow(n, 4));
    q(2, 2) = (Q11 + Q22 - 2 * Q12 - 2 * Q66) * c * c * n * n + Q66 * (std::pow(c, 4) + std::pow(n, 4));
    q(0, 2) = (Q11 - Q12 - 2 * Q66) * c * c * c * n + (Q12 - Q22 + 2 * Q66) * c * n * n * n;
    q(1, 2) = (Q11 - Q12 - 2 * Q66) * c * n * n * n + (Q12 - Q22 + 2 * Q66) * c * c * c * n;
    q(1, 0) = q(0, 1);
    q(2, 0) = q(0, 2);
    q(2, 1) = q(1, 2);
    const double low = -h / 2 + static_cast<double>(k) * height, high = low + height;
    s.A += height * q;
    s.B += (high * high - low * low) / 2 * q;
    s.D += (high * high * high - low * low * low) / 3 * q;
    rows1.emplace_back(q.row(0).transpose());
    rows2.emplace_back(q.row(1).transpose());
    G1.push_back(0.5 * c * c + 0.2 * n * n);
    G2.push_back(0.5 * n * n + 0.2 * c * c);
  }
  if (degrees == std::vector<double>{45, -45}) {
    s.S = textbook({0, 90}, h, k_s).S;
    return s;
  }
  Eigen::Matrix<double, 6, 6> all;
  all << s.A, s.B, s.B, s.D;
  const Eigen::Matrix<double, 6, 6> compliance = all.inverse();
  s.S = 6 * k_s / 5 *
        Eigen::Vector2d(shear_stiffness(rows1, G1, compliance.col(3), h),
                        shear_stiffness(rows2, G2, compliance.col(4), h));
  return s;
}

/// Navier's solution (U, V, W, X, Y) for the load sin(pi x) sin(pi y) on the unit square: u = (U, V), w = W, r = (X, Y)
/// times products of sines and cosines. Reddy, Mechanics of Laminated Composite Plates and Shells, sections 7.2 and 7.3.
Eigen::Matrix<double, 5, 1> navier(const Stiffness& s, bool is_cross_ply) {
  Eigen::Matrix<double, 5, 5> k = Eigen::Matrix<double, 5, 5>::Zero();
  const double p = pi * pi;
  const Eigen::Matrix3d &A = s.A, &B = s.B, &D = s.D;
  k.row(0) << p * (A(0, 0) + A(2, 2)), p * (A(0, 1) + A(2, 2)), 0, 0, 0;
  k(1, 1) = p * (A(2, 2) + A(1, 1));
  k.row(2) << 0, 0, p * (s.S[0] + s.S[1]), pi * s.S[0], pi * s.S[1];
  k.row(3) << 0, 0, 0, p * (D(0, 0) + D(2, 2)) + s.S[0], p * (D(0, 1) + D(2, 2));
  k(4, 4) = p * (D(2, 2) + D(1, 1)) + s.S[1];
  if (is_cross_ply) {
    k(0, 3) = p * (B(0, 0) + B(2, 2));
    k(0, 4) = k(1, 3) = p * (B(0, 1) + B(2, 2));
    k(1, 4) = p * (B(2, 2) + B(1, 1));
  } else {
    k(0, 3) = 2 * p * B(0, 2);
    k(0, 4) = k(1, 3) = p * (B(0, 2) + B(1, 2));
    k(1, 4) = 2 * p * B(1, 2);
  }
  k.triangularView<Eigen::StrictlyLower>() = k.transpose();
  Eigen::Matrix<double, 5, 1> load;
  load << 0, 0, 1, 0, 0;
  return k.ldlt().solve(load);
}

std::string plate(const std::string& materials, double thickness, bool is_cross_ply, const std::string& more = "") {
  const auto [on_sides, on_ends] = is_cross_ply ? std::pair("u.y", "u.x") : std::pair("u.x", "u.y");
  return materials + fmt::format(R"case([shell]
material = "stack"
shear_correction = "5/6"
thickness = {}
{}
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 1], cells = [4, 4] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 6
refinements = 0
[output]
axis = [1, 0, 0]
[[support]]
boundary = ["left", "right"]
fix = ["{}", "u.z", "r.y"]
[[support]]
boundary = ["bottom", "top"]
fix = ["{}", "u.z", "r.x"]
[[load]]
force = [0, 0, "sin(pi*x)*sin(pi*y)"]
[[probe]]
name = "centre"
at = [0.5, 0.5]
)case",
                                 thickness, more, on_sides, on_ends);
}

TEST(NavierPlate, OfAntisymmetricCrossPlyHasTheDeflectionAndTheStressesOfTheLayers) {
  const double h = 0.1;
  const auto exact = navier(textbook({0, 90}, h, 5.0 / 6), true);
  const auto result = solved(plate(carbon_layers({0, 90}), h, true));
  const recovery::PointValues& centre = result.probes.at(0).values;
  EXPECT_NEAR(centre.u[2], exact[2], 1e-7 * exact[2]);
  EXPECT_NEAR(result.summary.energy.total(), exact[2] / 8, 1e-7 * exact[2]);
  // In the lower layer, whose fibres run along x: sigma_11 = Q11 eps_1 + Q12 eps_2 with eps_a of the ansatz at the face.
  const double common = 1 - 0.25 * 0.25 / 25, e1 = -pi * (exact[0] - h / 2 * exact[3]),
               e2 = -pi * (exact[1] - h / 2 * exact[4]);
  const double stress = (25 * e1 + 0.25 * e2) / common;
  EXPECT_NEAR(shell::in_plane_stress(section_forces(centre), -h / 2)[0], stress, 1e-4 * std::abs(stress));
  ASSERT_EQ(result.layers.size(), 10u);
  const recovery::LayerStress& first = result.layers[0];
  EXPECT_EQ(first.component, "11");
  EXPECT_NEAR(first.least.stress, stress, 1e-4 * std::abs(stress));
  EXPECT_NEAR(first.least.height, -h / 2, 1e-14);
  EXPECT_LT((first.least.position - Eigen::Vector3d(0.5, 0.5, 0)).norm(), 1e-12);
  // Lengthwise stress of the fibres in the upper layer, which run along y: by symmetry the opposite.
  EXPECT_NEAR(result.layers[5].most.stress, -stress, 1e-4 * std::abs(stress));
  EXPECT_EQ(result.layers[5].angle, 90);
}

TEST(NavierPlate, OfAntisymmetricAngleAndOfSymmetricCrossPlyHasTheDeflection) {
  for (const double h : {0.2, 0.1, 0.01}) {
    const auto angle = navier(textbook({45, -45}, h, 5.0 / 6), false);
    EXPECT_NEAR(solved(plate(carbon_layers({45, -45}), h, false)).probes.at(0).values.u[2], angle[2], 1e-6 * angle[2]);
    const auto cross = navier(textbook({0, 90, 90, 0}, h, 5.0 / 6), true);
    EXPECT_NEAR(solved(plate(carbon_layers({0, 90, 90, 0}), h, true)).probes.at(0).values.u[2], cross[2],
                1e-6 * cross[2]);
  }
}

// N. J. Pagano and S. J. Hatfield, AIAA J. 10, 931-933, 1972: three-dimensional elasticity for sinusoidal loads. With 5/6 of the
// sum of the layers' moduli the deflections are 12, 11 and 5 % too small.
TEST(NavierPlate, IsNearThreeDimensionalElasticity) {
  for (const auto& [h, exact, tolerance] : {std::tuple(0.25, 1.954, 0.08), {0.1, 0.743, 0.03}, {0.05, 0.517, 0.03}}) {
    const double w = navier(textbook({0, 90, 90, 0}, h, 5.0 / 6), true)[2];
    EXPECT_NEAR(100 * w * h * h * h, exact, tolerance * exact) << h;
  }
}

TEST(NavierPlate, DoesNotDependOnTheFormulationOrOnWhoTurnsTheAxes) {
  const double h = 0.1;
  const auto exact = navier(textbook({45, -45}, h, 5.0 / 6), false);
  for (const char* formulation : {"penalised", "mixed", "classical"}) {
    const std::string more = fmt::format("formulation = \"{}\"", formulation);
    EXPECT_NEAR(solved(plate(carbon_layers({45, -45}), h, false, more)).probes.at(0).values.u[2], exact[2],
                1e-6 * exact[2])
        << formulation;
  }
  const double tilted = solved(plate(carbon_layers({0, -90}, "[1, 1, 0.7]"), h, false)).probes.at(0).values.u[2];
  EXPECT_NEAR(tilted, exact[2], 1e-6 * exact[2]);
}

// Lekhnitskii, Anisotropic Plates, Gordon and Breach 1968: a clamped ellipse with semi-axes a, b under a constant
// pressure has w = q a^4 / (8 (3 D11 + 2 (D12 + 2 D66) (a/b)^2 + 3 D22 (a/b)^4)) in the middle, without shear.
TEST(LekhnitskiisPlate, HasItsDeflection) {
  const double a = 1.5, h = 0.002;
  const Stiffness s = textbook({0}, h, 1);
  const double ratio = a * a,
               expected =
                   std::pow(a, 4) /
                   (8 * (3 * s.D(0, 0) + 2 * (s.D(0, 1) + 2 * s.D(2, 2)) * ratio + 3 * s.D(1, 1) * ratio * ratio));
  const auto result = solved(carbon_layers({0}) + fmt::format(R"case([shell]
material = "stack"
thickness = {}
[geometry]
domain = {{ disk = {{ radius = 1 }} }}
chart = ["{}*x", "y", "0"]
[mesh]
degree = 4
refinements = 2
[[support]]
boundary = "rim"
fix = ["u", "r"]
[[load]]
pressure = 1
[[probe]]
name = "centre"
at = [0, 0]
)case",
                                                              h, a));
  EXPECT_NEAR(result.probes.at(0).values.u[2], expected, 2e-4 * expected);
}

// Timoshenko, Analysis of bi-metal thermostats, 1925. The strip is held at one end; nu = 0.
TEST(BimetalStrip, CurlsAndHasTheStressesOfItsLayers) {
  const double h = 0.02, m = 0.6, n = 2.5, strain = 1e-4;
  const double curvature =
      6 * strain * (1 + m) * (1 + m) / (h * (3 * (1 + m) * (1 + m) + (1 + m * n) * (m * m + 1 / (m * n))));
  const auto result = solved(fmt::format(R"case([[material]]
name = "steel"
E = {}
nu = 0
[[material]]
name = "brass"
E = 1
nu = 0
[[material]]
name = "bimetal"
layers = [{{ material = "steel", thickness = {}, strain = [{}, 0, 0] }}, {{ material = "brass", thickness = 1 }}]
[shell]
material = "bimetal"
thickness = {}
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, 0.1], cells = [4, 1] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 3
refinements = 0
[[support]]
boundary = "left"
fix = ["u", "r"]
[[probe]]
name = "tip"
at = [1, 0.05]
[[probe]]
name = "middle"
at = [0.5, 0.05]
)case",
                                         n, m, strain, h));
  // The lower layer grows: the strip curls upwards.
  EXPECT_NEAR(result.probes.at(0).values.u[2], curvature / 2, 1e-9 * curvature);
  const recovery::PointValues& middle = result.probes.at(1).values;
  EXPECT_LT(middle.N.norm(), 1e-9 * strain * h);
  EXPECT_LT(middle.M.norm(), 1e-9 * strain * h * h);
  // Timoshenko's force in a layer, over the sum of both bending stiffnesses.
  const double a1 = h * m / (1 + m), a2 = h / (1 + m),
               moment = curvature * (n * std::pow(a1, 3) + std::pow(a2, 3)) / 12;
  const double force = 2 * moment / h;
  const double at_bottom = -force / a1 + n * curvature * a1 / 2, at_top = force / a2 - curvature * a2 / 2;
  const auto f = section_forces(middle);
  EXPECT_NEAR(shell::in_plane_stress(f, -h / 2)[0], at_bottom, 1e-8 * force / a1);
  EXPECT_NEAR(shell::in_plane_stress(f, h / 2)[0], at_top, 1e-8 * force / a1);
  EXPECT_LT(result.certificate.energy_identity, 1e-8);
}

// A tube whose fibres run around it widens by p R^2 / (E1 e), with fibres along it by p R^2 / (E2 e), to O(e/R)^2.
TEST(Tube, HasTheStiffnessOfItsFibres) {
  const double R = 1, e = 0.01, p = 1e-3;
  for (const auto& [angle, modulus] : {std::pair(90, 25.0), std::pair(0, 1.0)}) {
    const auto result = solved(carbon_layers({static_cast<double>(angle)}) + fmt::format(R"case([shell]
material = "stack"
thickness = {}
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = [1, "pi/2"], cells = [2, 4] }} }}
chart = ["x", "cos(y)", "sin(y)"]
[mesh]
degree = 4
refinements = 1
[[support]]
boundary = ["left", "bottom", "top"]
fix = ["symmetry"]
[[load]]
pressure = {}
[[probe]]
name = "end"
at = [1, 0]
)case",
                                                                                         e, -p));
    const double expected = p * R * R / (modulus * e);
    EXPECT_NEAR(std::abs(result.probes.at(0).values.u[1]), expected, 2e-4 * expected) << angle;
  }
}

std::string sandwich(double face, double core, double modulus, const std::string& more) {
  return fmt::format(R"case([[material]]
name = "al"
E = 70000
nu = 0
[[material]]
name = "foam"
E1 = 50
E2 = 50
nu12 = 0
G12 = 20
G13 = {2}
G23 = {2}
[[material]]
name = "sandwich"
layers = [{{ material = "al", thickness = {0} }}, {{ material = "foam", thickness = {1} }}, {{ material = "al", thickness = {0} }}]
[shell]
material = "sandwich"
thickness = {3}
{4}
[geometry]
domain = {{ rectangle = {{ to = [500, 50], cells = [4, 1] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 0
[[support]]
boundary = "left"
fix = ["u"]
[[support]]
boundary = "right"
fix = ["u.z"]
[[load]]
force = [0, 0, -0.002]
[[probe]]
name = "mid"
at = [250, 25]
)case",
                     face, core, modulus, face * 2 + core, more);
}

// A hinged strip with thin faces on a soft core: w = 5 q L^4 / (384 D) + q L^2 / (8 S), and S is nearly G d^2 / c with the
// distance d of the faces' middles and the thickness c of the core.
TEST(Sandwich, DeflectsByTheShearOfItsCore) {
  for (const auto& [face, core, modulus] :
       {std::array{1.0, 20.0, 20.0}, std::array{0.5, 20.0, 5.0}, std::array{1.0, 8.0, 60.0}}) {
    const double d = face + core, D = 70000 * face * (d * d / 2 + face * face / 6) + 50 * std::pow(core, 3) / 12,
                 bending = 5 * 0.002 * std::pow(500, 4) / (384 * D),
                 shear = 0.002 * 500 * 500 / (8 * modulus * d * d / core);
    for (const char* more : {"", "shear_correction = \"5/6\""}) {
      const auto result = solved(sandwich(face, core, modulus, more));
      EXPECT_NEAR(-result.probes.at(0).values.u[2], bending + shear, 0.01 * shear) << face << ' ' << core << more;
    }
  }
}

// NAFEMS, Composite Benchmarks, R0031, test 3: a sandwich plate under a constant pressure. Stresses in the middle of the lower face.
TEST(Sandwich, OfNafemsHasTheDeflectionAndTheStresses) {
  const auto result = solved(R"case([[material]]
name = "face"
E1 = 1e7
E2 = 4e6
nu12 = 0.3
G12 = 1.875e6
G13 = 1.875e6
G23 = 1.875e6
[[material]]
name = "core"
E1 = 10
E2 = 10
nu12 = 0
G12 = 10
G13 = 3e4
G23 = 1.2e4
[[material]]
name = "sandwich"
layers = [{ material = "face", thickness = 0.028 }, { material = "core", thickness = 0.75 }, { material = "face", thickness = 0.028 }]
[shell]
material = "sandwich"
thickness = 0.806
[geometry]
domain = { rectangle = { to = [5, 5], cells = [4, 4] } }
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 0
[output]
axis = [1, 0, 0]
[[support]]
boundary = ["left", "bottom"]
fix = ["symmetry"]
[[support]]
boundary = ["right", "top"]
fix = ["u.t", "u.z", "r.t"]
[[load]]
force = [0, 0, -100]
[[probe]]
name = "centre"
at = [0, 0]
[[probe]]
name = "corner"
at = [5, 5]
)case");
  const recovery::PointValues &centre = result.probes.at(0).values, &corner = result.probes.at(1).values;
  EXPECT_NEAR(centre.u[2], -0.123, 0.001);
  const auto stress = shell::in_plane_stress(section_forces(centre), -0.389);
  EXPECT_NEAR(stress[0], 34449, 0.02 * 34449);
  EXPECT_NEAR(stress[1], 13390, 0.04 * 13390);
  // The double series of this plate: sum of 16 q / (pi^2 m n) over odd m, n.
  EXPECT_NEAR(std::abs(shell::in_plane_stress(section_forces(corner), -0.389)[2]), 13087, 0.02 * 13087);
}

// NAFEMS, Composite Benchmarks, R0031, test 1: a strip of seven plies on two supports under a line load in the middle; a half.
TEST(LaminatedStrip, OfNafemsHasTheDeflectionAndTheStresses) {
  std::string text = R"case([[material]]
name = "ply"
E1 = 100e3
E2 = 5e3
nu12 = 0.4
G12 = 3e3
G13 = 3e3
G23 = 2e3
[[material]]
name = "stack"
)case";
  for (int ply = 0; ply < 7; ++ply)
    text += fmt::format("[[material.layers]]\nmaterial = \"ply\"\nthickness = {}\nangle = {}\n", ply == 3 ? 0.4 : 0.1,
                        ply % 2 == 0 ? 0 : 90);
  const auto result = solved(text + R"case([shell]
material = "stack"
thickness = 1
[geometry]
domain = { rectangle = { to = [15, 10], cells = [4, 3] } }
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 0
[output]
axis = [1, 0, 0]
[[support]]
boundary = "left"
fix = ["symmetry"]
[[support]]
boundary = "right"
fix = ["u.z"]
[[support]]
point = [0, 5]
fix = ["u.y"]
[[load]]
boundary = "left"
force = [0, 0, -5]
[[probe]]
name = "middle"
at = [0, 5]
[[probe]]
name = "quarter"
at = [7.5, 5]
)case");
  const recovery::PointValues &middle = result.probes.at(0).values, &quarter = result.probes.at(1).values;
  EXPECT_NEAR(middle.u[2], -1.06, 0.01);
  EXPECT_NEAR(shell::in_plane_stress(section_forces(middle), -0.5)[0], 683.9, 0.01 * 683.9);
  EXPECT_NEAR(std::abs(shell::shear_stress(section_forces(quarter), -0.4)[0]), 4.1, 0.01 * 4.1);
}

/// A strip clamped at x = -1 and 1, pressed by q on a floor at the distance g below it. Between -c and c it lies on the
/// floor, and its rotation is sinh(x / delta). Bending stiffness D, shear stiffness S.
struct StripOnFloor {
  double D, S, q, g;

  /// Deflection and rotation at the clamped end for a contact edge c and the rotation there. Outside M' = Q, Q' = q,
  /// r' = M/D, w' = Q/S - r; at the edge w' = 0, so Q = S r.
  std::array<double, 2> at_end(double c, double r) const {
    const double delta = std::sqrt(D / S), Q = S * r, M = D * r / delta / std::tanh(c / delta), l = 1 - c;
    const double end = r + (M * l + Q * l * l / 2 + q * l * l * l / 6) / D;
    const double rise =
        (Q * l + q * l * l / 2) / S - (r * l + (M * l * l / 2 + Q * l * l * l / 6 + q * l * l * l * l / 24) / D);
    return {-g + rise, end};
  }
  /// Returns c and the rotation at the edge.
  std::array<double, 2> solve() const {
    double low = 0.01, high = 0.999;
    const auto rotation = [&](double c) {  // `end` is linear in r
      const double zero = at_end(c, 0)[1];
      return -zero / (at_end(c, 1)[1] - zero);
    };
    for (int i = 0; i < 200; ++i) {
      const double c = (low + high) / 2;
      (at_end(c, rotation(c))[0] > 0 ? low : high) = c;
    }
    return {low, rotation(low)};
  }
};

TEST(OrthotropicStrip, LiesOnAFloorAsItsOneDimensionalSolution) {
  const double e = 0.05, g = 0.05, q = 0.02;
  const double D = 25 / (1 - 0.25 * 0.25 / 25) * e * e * e / 12, S = 0.5 * e;
  const StripOnFloor strip{.D = D, .S = S, .q = q, .g = g};
  const auto [c, r] = strip.solve();
  ASSERT_GT(c, 0.05);
  ASSERT_LT(c, 0.95);
  const auto result = solved(carbon_layers({0}) + fmt::format(R"case([shell]
material = "stack"
thickness = {}
[geometry]
domain = {{ rectangle = {{ from = [-1, 0], to = [1, 0.1], cells = [16, 1] }} }}
chart = ["x", "y", "0"]
[accuracy]
reaction = 1e-4
energy = 1e-4
contact_area = 1e-3
[[support]]
boundary = ["left", "right"]
fix = ["u", "r"]
[[support]]
boundary = ["bottom", "top"]
fix = ["u.y", "r.y"]
[[load]]
force = [0, 0, {}]
[[obstacle]]
half_space = {{ point = [0, 0, {}], normal = [0, 0, 1] }}
face = "lower"
)case",
                                                              e, -q, -g - e / 2));
  // The floor carries the load on the contact zone and the shear forces at its two edges.
  const double carried = 0.1 * 2 * (q * c - S * r);
  EXPECT_NEAR(result.summary.reaction.force[2], carried, 1e-4 * carried);
  EXPECT_NEAR(result.summary.contact_area, 0.1 * 2 * c, 1e-3 * 0.2 * c);
}

}  // namespace
}  // namespace plastron
