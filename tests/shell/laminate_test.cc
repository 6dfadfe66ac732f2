// Cross-sections of laminates: stiffness, stresses over the thickness, initial strains.
#include <plastron/shell/section_stress.hpp>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>

#include "shell/random_fields.hpp"

namespace plastron::shell {
namespace {

constexpr double pi = std::numbers::pi;
const Orthotropic carbon{.E1 = 25, .E2 = 1, .nu12 = 0.25, .G12 = 0.5, .G13 = 0.5, .G23 = 0.2};

Frame some_frame() {
  return geometry::frame_at({.value = Vector3d::Zero(),
                             .d = {Vector3d(1, 0.3, 0.2), Vector3d(-0.2, 1.4, 0.5)},
                             .dd = {Vector3d(0.1, 0, 0.3), Vector3d(0, 0.2, 0.1), Vector3d(0, 0, -0.4)}});
}

/// As at a node of a mesh in space, where the director is the mean of the normals of its cells.
Frame frame_with_inclined_director() {
  const Frame f = some_frame();
  return geometry::frame_with_director(f.phi, f.a_cov, (f.a3 + Vector3d(0.2, -0.1, 0.05)).normalized(), f.da3);
}

std::vector<Layer> layers(const Orthotropic& material, const std::vector<double>& degrees) {
  std::vector<Layer> all;
  for (const double angle : degrees) all.push_back({.material = material, .angle = angle * pi / 180});
  return all;
}

Material stacked(std::vector<Layer> layers, const Vector3d& direction = Vector3d::UnitX(), double k_s = 5.0 / 6) {
  return {std::make_shared<const Laminate>(std::move(layers), direction), k_s};
}

Frame plane() { return orthonormal_frame(Vector3d::UnitX(), Vector3d::UnitY()); }

void expect_same(const Section& a, const Section& b, double tolerance = 1e-13) {
  EXPECT_LT((a.membrane - b.membrane).norm(), tolerance * b.membrane.norm());
  EXPECT_LT((a.bending - b.bending).norm(), tolerance * b.bending.norm());
  EXPECT_LT((a.shear - b.shear).norm(), tolerance * b.shear.norm());
  EXPECT_LT((a.coupling - b.coupling).norm(), tolerance * (b.membrane * b.bending).norm());
}

TEST(Laminate, OfIsotropicLayersIsTheIsotropicSection) {
  const Orthotropic steel = Orthotropic::isotropic(7, 0.28);
  const std::vector<Layer> stack{{.material = steel, .part = 1, .angle = 0.3},
                                 {.material = steel, .part = 2.5, .angle = -1.1},
                                 {.material = steel, .part = 0.2, .angle = 2}};
  for (const Frame& frame : {plane(), some_frame(), frame_with_inclined_director()})
    expect_same(section_at(stacked(stack, {1, 2, -0.3}), frame, 0.13),
                section_at(Material::from_young_poisson(7, 0.28, 5.0 / 6), frame, 0.13));
}

TEST(Laminate, TurnsItsLayersByTheAngleOrByTheDirection) {
  const double angle = 0.4;
  auto turned = layers(carbon, {0, 30, 75});
  for (Layer& layer : turned) layer.angle += angle;
  for (const Frame& frame : {plane(), some_frame()}) {
    const Vector3d t1 = geometry::tangential(Vector3d::UnitX(), frame.a3).normalized(), t2 = frame.a3.cross(t1);
    expect_same(
        section_at(stacked(turned), frame, 0.1),
        section_at(stacked(layers(carbon, {0, 30, 75}), std::cos(angle) * t1 + std::sin(angle) * t2), frame, 0.1));
  }
}

TEST(Laminate, OfOneLayerHasItsConstantsAlongItsAxes) {
  const double e = 0.2;
  const Section s = section_at(stacked(layers(carbon, {0})), plane(), e);
  const Eigen::Matrix3d compliance = s.membrane.inverse() * e;
  EXPECT_NEAR(compliance(0, 0), 1 / carbon.E1, 1e-14);
  EXPECT_NEAR(compliance(1, 1), 1 / carbon.E2, 1e-14);
  EXPECT_NEAR(compliance(1, 0), -carbon.nu12 / carbon.E1, 1e-14);
  EXPECT_NEAR(compliance(2, 2), 1 / carbon.G12, 1e-14);
  EXPECT_NEAR(s.shear(0, 0), 5.0 / 6 * e * carbon.G13, 1e-15);
  EXPECT_NEAR(s.shear(1, 1), 5.0 / 6 * e * carbon.G23, 1e-15);
  const Section across = section_at(stacked(layers(carbon, {90})), plane(), e);
  EXPECT_NEAR(across.membrane(1, 1), s.membrane(0, 0), 1e-14 * s.membrane(0, 0));
  EXPECT_NEAR(across.shear(1, 1), s.shear(0, 0), 1e-15);
}

TEST(Laminate, CouplesMembraneAndBendingOnlyWhereItIsNotSymmetric) {
  const double e = 0.1;
  const auto coupling = [&](const std::vector<double>& degrees) {
    return section_at(stacked(layers(carbon, degrees)), plane(), e).coupling;
  };
  const double size = 25 * e * e;
  EXPECT_LT(coupling({0, 90, 90, 0}).norm(), 1e-15 * size);
  EXPECT_LT(coupling({30, -45, -45, 30}).norm(), 1e-15 * size);
  const Eigen::Matrix3d cross = coupling({0, 90}), angle = coupling({45, -45});
  EXPECT_NEAR(cross(0, 0), -cross(1, 1), 1e-15 * size);
  EXPECT_LT(cross(0, 0), -0.1 * size);  // the lower layer is the stiff one
  EXPECT_NEAR(cross(2, 2), 0, 1e-15 * size);
  EXPECT_NEAR(angle(0, 0), 0, 1e-15 * size);
  EXPECT_LT(angle(0, 2), -0.05 * size);
  EXPECT_NEAR(angle(0, 2), angle(1, 2), 1e-14 * size);
}

TEST(Laminate, HasEnergyForEveryStrain) {
  const Section s = section_at(stacked(layers(carbon, {10, -50, 80})), some_frame(), 0.1);
  const auto c = s.in_plane();
  EXPECT_LT((c - c.transpose()).norm(), 1e-14 * c.norm());
  EXPECT_GT((Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(c).eigenvalues().minCoeff()), 0);
  Random random;
  const Strain<double> strain{random.vector(), random.vector(), Eigen::Vector2d(0.3, -0.2)};
  const EnergyDensity e = energy_density(s, strain);
  EXPECT_NEAR(e.membrane + e.bending + e.shear, total_energy_density(s, strain), 1e-14);
  Vector8 all;
  all << strain.membrane, strain.bending, strain.shear;
  EXPECT_LT((s.strains_of(s.resultants_of(all)) - all).norm(), 1e-12 * all.norm());
  const Resultants<double> n = resultants(s, strain);
  EXPECT_LT((s.resultants_of(all).head<3>() - n.membrane).norm(), 1e-14 * n.membrane.norm());
  EXPECT_LT((s.resultants_of(all).segment<3>(3) - n.bending).norm(), 1e-14 * n.bending.norm());
}

TEST(Orthotropic, IsPositiveDefiniteWithinItsBounds) {
  EXPECT_TRUE(carbon.is_positive_definite());
  Orthotropic wrong = carbon;
  wrong.nu12 = 5.0001;
  EXPECT_FALSE(wrong.is_positive_definite());
  wrong.nu12 = 4.9999;
  EXPECT_TRUE(wrong.is_positive_definite());
  wrong.G23 = 0;
  EXPECT_FALSE(wrong.is_positive_definite());
}

TEST(Laminate, HasNoAxesWhereItsDirectionIsNormal) {
  const Laminate laminate(layers(carbon, {0}), {0, 0, 3});
  EXPECT_FALSE(laminate.has_axes(Vector3d::UnitZ()));
  EXPECT_FALSE(laminate.has_axes(-Vector3d::UnitZ()));
  EXPECT_TRUE(laminate.has_axes(Vector3d(0.02, 0, 1).normalized()));
}

/// Resultants of a laminate, different for every seed, in axes that are turned against its direction.
SectionForces laminate_forces(int seed, double load_factor = 0) {
  auto value = [k = 0, seed]() mutable { return std::sin(1.7 * seed + 2.3 * ++k); };
  SectionForces f;
  for (Eigen::Index i = 0; i < 3; ++i) f.N[i] = value();
  for (Eigen::Index i = 0; i < 3; ++i) f.M[i] = 0.03 * value();
  for (Eigen::Index i = 0; i < 2; ++i) f.Q[i] = value();
  f.thickness = 0.1;
  auto stack = layers(carbon, {20, -60, 90});
  stack[1].part = 2;
  stack[2].strain = {0.01, -0.02, 0.005};
  f.laminate =
      std::make_shared<const LaminateSection>(std::make_shared<const Laminate>(stack, Vector3d(1, 0.4, 0)), plane(),
                                              f.thickness, 5.0 / 6, InitialState{.strains = load_factor});
  return f;
}

/// Sum over all layers of three Gauss points each.
template <class Function>
auto over_layers(const SectionForces& f, const Function& function) {
  auto sum = (0 * function(0, 0.0)).eval();
  for (std::size_t k = 0; k < f.laminate->layer_count(); ++k) {
    const double bottom = f.laminate->interface(k), height = f.laminate->interface(k + 1) - bottom;
    for (const auto& [point, weight] :
         {std::pair(-std::sqrt(0.6), 5.0), std::pair(0.0, 8.0), std::pair(std::sqrt(0.6), 5.0)})
      sum += height / 18 * weight * function(k, bottom + height / 2 * (1 + point));
  }
  return sum;
}

TEST(LaminateStress, IntegratesToTheResultants) {
  for (int seed = 0; seed < 20; ++seed)
    for (const double load_factor : {0.0, 1.0, -0.5}) {
      const SectionForces f = laminate_forces(seed, load_factor);
      const auto at = [&](std::size_t k, double z) { return stress_of(f.laminate->stress(k, z), f); };
      const Vector3d N = over_layers(f, [&](std::size_t k, double z) { return Vector3d(at(k, z).in_plane); });
      const Vector3d M = over_layers(f, [&](std::size_t k, double z) { return Vector3d(z * at(k, z).in_plane); });
      const Eigen::Vector2d Q =
          over_layers(f, [&](std::size_t k, double z) { return Eigen::Vector2d(at(k, z).shear); });
      EXPECT_LT((N - f.N).norm(), 1e-13);
      EXPECT_LT((M - f.M).norm(), 1e-14);
      EXPECT_LT((Q - f.Q).norm(), 1e-13);
    }
}

TEST(Laminate, HasTheShearStiffnessWithTheEnergyOfItsShearStresses) {
  for (int seed = 0; seed < 20; ++seed) {
    SectionForces f = laminate_forces(seed);
    const double more = std::sin(seed + 0.5);
    std::vector<Layer> stack = layers(carbon, {20 + 90 * more, -60, 90 * std::cos(seed)});
    stack[1].part = 1 + more;
    if (seed % 2 == 0)
      stack[1].material = Orthotropic{.E1 = 0.1, .E2 = 0.2, .nu12 = 0.1, .G12 = 0.1, .G13 = 0.02, .G23 = 0.01};
    f.laminate = std::make_shared<const LaminateSection>(std::make_shared<const Laminate>(stack, Vector3d(1, more, 0)),
                                                         plane(), f.thickness, 5.0 / 6, InitialState{});
    const auto energy = over_layers(f, [&](std::size_t k, double z) {
      const Eigen::Vector2d own = stress_of(f.laminate->stress_in_layer_axes(k, z), f).shear;
      const Orthotropic& m = stack[k].material;
      return Eigen::Matrix<double, 1, 1>(own[0] * own[0] / m.G13 + own[1] * own[1] / m.G23);
    });
    const double expected = f.Q.dot(f.laminate->section().shear.llt().solve(f.Q));
    EXPECT_NEAR(energy[0], expected, 1e-12 * expected) << seed;
  }
}

TEST(Laminate, LetsItsFacesBendAloneOnlyOnASoftCore) {
  const Orthotropic steel = Orthotropic::isotropic(200, 0);
  for (const double soft : {1e-4, 1e-3, 0.02}) {
    const Orthotropic foam = Orthotropic::isotropic(soft, 0);
    const Laminate one({{.material = steel, .part = 1}, {.material = foam, .part = 8}, {.material = steel, .part = 1}},
                       {1, 0, 0});
    const double S = soft / 2 * 0.9 * 0.9 / 0.8, bending = 200 * 2 * std::pow(0.1, 3) / 12;
    EXPECT_NEAR(one.face_length(), std::sqrt(bending / S), 0.01 * one.face_length());
    // A face in two layers is the same face.
    const Laminate split({{.material = steel, .part = 0.5},
                          {.material = steel, .part = 0.5},
                          {.material = foam, .part = 8},
                          {.material = steel, .part = 1}},
                         {1, 0, 0});
    EXPECT_NEAR(split.face_length(), one.face_length(), 1e-12);
  }
  EXPECT_EQ(Laminate(layers(carbon, {0, 90, 45}), {1, 0, 0}).face_length(), 0);
  EXPECT_EQ(Laminate({{.material = steel}, {.material = Orthotropic::isotropic(70, 0.3)}}, {1, 0, 0}).face_length(), 0);
}

TEST(LaminateStress, OfTransverseShearVanishesOnTheFacesAndIsContinuous) {
  const SectionForces f = laminate_forces(3);
  const auto shear = [&](std::size_t k, double z) { return stress_of(f.laminate->stress(k, z), f).shear; };
  EXPECT_LT(shear(0, -0.05).norm(), 1e-14);
  EXPECT_LT(shear(2, 0.05).norm(), 1e-13);
  for (const std::size_t k : {0, 1}) {
    const double z = f.laminate->interface(k + 1);
    EXPECT_LT((shear(k, z) - shear(k + 1, z)).norm(), 1e-13);
    EXPECT_GT(shear(k, z).norm(), 1);
  }
}

TEST(LaminateStress, OfAHomogeneousLaminateIsThatOfAHomogeneousSection) {
  for (int seed = 0; seed < 5; ++seed) {
    SectionForces f = laminate_forces(seed), homogeneous = f;
    homogeneous.laminate = nullptr;
    f.laminate = std::make_shared<const LaminateSection>(
        std::make_shared<const Laminate>(layers(carbon, {25, 25, 25}), Vector3d(1, 0.4, 0)), plane(), f.thickness, 1,
        InitialState{});
    for (const double z : {-0.05, -0.03, 0.0, 0.01, 0.05}) {
      EXPECT_LT((in_plane_stress(f, z) - in_plane_stress(homogeneous, z)).norm(), 1e-11);
    }
    f.laminate = std::make_shared<const LaminateSection>(
        std::make_shared<const Laminate>(layers(Orthotropic::isotropic(3, 0.3), {25, 5}), Vector3d(1, 0.4, 0)), plane(),
        f.thickness, 1, InitialState{});
    for (const double z : {-0.05, -0.03, 0.0, 0.01, 0.05}) {
      EXPECT_LT((in_plane_stress(f, z) - in_plane_stress(homogeneous, z)).norm(), 1e-11);
      EXPECT_LT((shear_stress(f, z) - shear_stress(homogeneous, z)).norm(), 1e-11);
      EXPECT_NEAR(von_mises_at(f, z), von_mises_at(homogeneous, z), 1e-11);
    }
    EXPECT_NEAR(largest_von_mises(f).stress, largest_von_mises(homogeneous).stress, 1e-9);
  }
}

TEST(LaminateStress, InALayersAxesHasTheSameInvariants) {
  const SectionForces f = laminate_forces(4, 1);
  for (const std::size_t k : {0, 1, 2}) {
    const double z = f.laminate->interface(k) + 0.003;
    const Stress s = stress_of(f.laminate->stress(k, z), f), own = stress_of(f.laminate->stress_in_layer_axes(k, z), f);
    EXPECT_NEAR(own.in_plane[0] + own.in_plane[1], s.in_plane[0] + s.in_plane[1], 1e-12);
    EXPECT_NEAR(von_mises(own), von_mises(s), 1e-12);
    EXPECT_NEAR(own.shear.norm(), s.shear.norm(), 1e-12);
  }
  // The layer at 90 degrees: its axis 1 is a quarter turn from the laminate's, which is 21.8 degrees from t1.
  const double angle = std::atan(0.4) + pi / 2, c = std::cos(angle), s = std::sin(angle);
  const Vector3d t = stress_of(f.laminate->stress(2, 0.05), f).in_plane;
  EXPECT_NEAR(stress_of(f.laminate->stress_in_layer_axes(2, 0.05), f).in_plane[0],
              c * c * t[0] + s * s * t[1] + 2 * c * s * t[2], 1e-12);
}

TEST(LaminateStress, TheLargestVonMisesIsNowhereExceededAndItsDerivativeIsThatOfDifferences) {
  for (int seed = 0; seed < 20; ++seed) {
    SectionForces f = laminate_forces(seed, 1);
    if (seed % 2 == 0) f.Q *= 20;
    const LargestVonMises found = largest_von_mises(f);
    double sampled = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (int i = 0; i <= 500; ++i) {
        const double bottom = f.laminate->interface(k), z = bottom + (f.laminate->interface(k + 1) - bottom) * i / 500;
        sampled = std::max(sampled, von_mises(stress_of(f.laminate->stress(k, z), f)));
      }
    EXPECT_GE(found.stress, sampled * (1 - 1e-12)) << seed;
    EXPECT_LE(found.stress, sampled * (1 + 1e-4)) << seed;
    const double z = 0.013, step = 1e-6;
    const Vector8 derivative = von_mises_derivative(f, z);
    for (Eigen::Index i = 0; i < 8; ++i) {
      const auto moved = [&](double by) {
        SectionForces g = f;
        (i < 3 ? g.N[i] : i < 6 ? g.M[i - 3] : g.Q[i - 6]) += by;
        return von_mises_at(g, z);
      };
      EXPECT_NEAR((moved(step) - moved(-step)) / (2 * step), derivative[i], 1e-5 * derivative.norm());
    }
  }
}

// Timoshenko, Analysis of bi-metal thermostats, J. Opt. Soc. Am. 11, 1925: the curvature of a free strip of two metals.
TEST(InitialStrain, CurlsAStripOfTwoMetalsAsTimoshenkoSays) {
  const double m = 0.6, n = 2.5, strain = 1e-3, h = 0.02;  // thickness and modulus of the lower over those of the upper
  const std::vector<Layer> stack{{.material = Orthotropic::isotropic(n, 0), .part = m, .strain = {strain, 0, 0}},
                                 {.material = Orthotropic::isotropic(1, 0), .part = 1}};
  const Section s = section_at(stacked(stack), plane(), h);
  const Vector8 free = s.strains_of(s.initial_resultants());
  const double expected =
      6 * strain * (1 + m) * (1 + m) / (h * (3 * (1 + m) * (1 + m) + (1 + m * n) * (m * m + 1 / (m * n))));
  EXPECT_NEAR(free[3], -expected, 1e-12 * expected);  // the lower layer grows: fibres above the mid-surface get shorter
  EXPECT_NEAR(free[4], 0, 1e-15);
}

// A temperature is the sum of a strain that is alike in all layers and of one that is linear in the height.
TEST(Temperature, StrainsALaminateLikeInitialStrainsOfItsLayers) {
  const double mean = 30, difference = -50, h = 0.02;
  std::vector<Layer> stack{{.material = Orthotropic{.E1 = 2, .E2 = 1, .nu12 = 0.2, .G12 = 0.4, .G13 = 0.3, .G23 = 0.2},
                            .part = 0.4,
                            .angle = 0.3},
                           {.material = Orthotropic::isotropic(1.5, 0.3), .part = 0.6, .angle = -1}};
  stack[0].material.expansion1 = 1e-5;
  stack[0].material.expansion2 = 3e-5;
  stack[1].material.expansion1 = stack[1].material.expansion2 = 2e-5;
  std::vector<Layer> thin;  // each layer in many, with the strain of the temperature in its middle
  const int parts = 400;
  double z = -0.5;
  for (const Layer& layer : stack)
    for (int k = 0; k < parts; ++k) {
      Layer one = layer;
      one.part = layer.part / parts;
      one.strain = (mean + (z + one.part / 2) * difference) * layer.material.expansion();
      z += one.part;
      thin.push_back(one);
    }
  const Vector8 by_temperature = section_at(stacked(stack), plane(), h, {.temperature = mean, .difference = difference})
                                     .initial_resultants(),
                by_strains = section_at(stacked(thin), plane(), h).initial_resultants();
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(by_temperature[k], by_strains[k], 1e-5 * std::abs(by_strains[k]) + 1e-18) << k;
}

TEST(Temperature, StrainsOneIsotropicLayerLikeThatMaterial) {
  const double expansion = 1.2e-5;
  const InitialState hot{.temperature = 40, .difference = 15};
  Material material = Material::from_young_poisson(3, 0.3, 1);
  std::get<Isotropic>(material.law).expansion = expansion;
  const geometry::Frame frame = orthonormal_frame(Vector3d(1, 0, 0), Vector3d(0, 0.6, 0.8));
  const Vector8 own = section_at(material, frame, 0.1, hot).initial_resultants(),
                of_layer =
                    section_at(stacked({{.material = Orthotropic::isotropic(3, 0.3, expansion)}}), frame, 0.1, hot)
                        .initial_resultants();
  EXPECT_LT((own - of_layer).norm(), 1e-12 * own.norm());
  EXPECT_NEAR(own[0], 0.1 * 3 / 0.7 * expansion * 40, 1e-15);
  EXPECT_NEAR(own[3], 0.1 * 0.1 * 3 / 0.7 / 12 * expansion * 15, 1e-16);
}

}  // namespace
}  // namespace plastron::shell
