// The manufactured solutions and their loads against stored values of independent computations, and their energies
// with the strains and stiffnesses of shell/ (M4-M9).
#include "verification/manufactured.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <plastron/geometry/chart.hpp>
#include <plastron/shell/material.hpp>

namespace plastron::verification {

namespace {

nlohmann::json reference(const char* key) {
  std::ifstream file(PLASTRON_REFERENCE_DIR "/manufactured.json");
  return nlohmann::json::parse(file).at(key);
}

Vector3d vector(const nlohmann::json& v) { return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()}; }

Manufactured solution(const nlohmann::json& entry, double thickness) {
  const bool contact = entry.at("case") == "contact";
  return {contact ? ManufacturedSolution::contact : ManufacturedSolution::clamped, {.thickness = thickness}};
}

#define EXPECT_SAME_VECTOR(a, b, relative) EXPECT_LE((a - b).norm(), (relative) * (b).norm()) << #a

// Composite five-point Gauss rule on the unit square.
template <class Function>
void integrate(int cells, const Function& add) {
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double w_inner = (322 + 13 * std::sqrt(70.0)) / 1800, w_outer = (322 - 13 * std::sqrt(70.0)) / 1800;
  const double point[5] = {-outer, -inner, 0, inner, outer};
  const double weight[5] = {w_outer, w_inner, 64.0 / 225, w_inner, w_outer};
  const double h = 1.0 / cells;
  for (int i = 0; i < cells * 5; ++i)
    for (int j = 0; j < cells * 5; ++j) {
      const double x = h * (i / 5 + 0.5 + point[i % 5] / 2), y = h * (j / 5 + 0.5 + point[j % 5] / 2);
      add(x, y, h * h * weight[i % 5] * weight[j % 5]);
    }
}

using Integrals = std::map<std::string, double>;

Integrals integrals(const Manufactured& exact, int cells) {
  const geometry::Chart chart(Manufactured::chart(), {});
  const auto& [E, nu, e, ks] = exact.shell();
  const auto material = shell::Material::from_young_poisson(E, nu, ks);
  Integrals sum;
  integrate(cells, [&, e = e](double x, double y, double weight) {
    const geometry::Frame frame = geometry::frame_at(chart(x, y));
    const ExactField u = exact.u(x, y), r = exact.r(x, y);
    const auto strain = shell::strain<double>({u.d, r.value, r.d}, frame);
    const auto density = shell::energy_density(shell::section_at(material, frame, e), strain);
    const ExactLoad load = exact.load(x, y);
    const double dS = weight * frame.sqrt_a;
    sum["area"] += dS;
    sum["E_membrane"] += dS * density.membrane;
    sum["E_bending"] += dS * density.bending;
    sum["E_shear"] += dS * density.shear;
    sum["load_work"] += dS * (load.force.dot(u.value) + load.couple.dot(r.value));
    sum["total_reaction"] += dS * exact.eta(x, y);
    sum["virtual_gap_work"] += dS * exact.eta(x, y) * (u.value - e / 2 * r.value)[2];
  });
  return sum;
}

}  // namespace

TEST(Manufactured, FieldsAndLoadsAreTheReferenceValues) {
  for (const auto& sample : reference("samples")) {
    const Manufactured exact = solution(sample, 0.1);
    const double x = sample.at("x"), y = sample.at("y");
    SCOPED_TRACE(sample.dump());
    EXPECT_SAME_VECTOR(exact.u(x, y).value, vector(sample.at("u")), 1e-12);
    EXPECT_SAME_VECTOR(exact.r(x, y).value, vector(sample.at("r")), 1e-12);
    EXPECT_SAME_VECTOR(exact.force(x, y), vector(sample.at("f")), 1e-12);
    EXPECT_SAME_VECTOR(exact.couple(x, y), vector(sample.at("m")), 1e-12);
    EXPECT_NEAR(exact.eta(x, y), sample.at("eta"), 1e-15);
  }
}

TEST(Manufactured, DerivativesAreThoseOfTheFields) {
  const double h = 1e-5;
  for (const auto kind : {ManufacturedSolution::clamped, ManufacturedSolution::contact}) {
    const Manufactured exact(kind, {});
    for (const auto& [x, y] : {std::pair{0.31, 0.62}, std::pair{0.08, 0.9}}) {
      const Vector3d du = (exact.u(x + h, y).value - exact.u(x - h, y).value) / (2 * h);
      const Vector3d dr = (exact.r(x, y + h).value - exact.r(x, y - h).value) / (2 * h);
      EXPECT_SAME_VECTOR(exact.u(x, y).d[0], du, 1e-7);
      EXPECT_SAME_VECTOR(exact.r(x, y).d[1], dr, 1e-7);
    }
  }
}

TEST(Manufactured, TheContactSolutionMeetsItsConditions) {
  const Manufactured exact(ManufacturedSolution::contact, {});
  const geometry::Chart chart(Manufactured::chart(), {});
  integrate(10, [&](double x, double y, double) {
    const geometry::SurfaceJet phi = chart(x, y);
    const geometry::Frame frame = geometry::frame_at(phi);
    const double gap = exact.gap(x, y), eta = exact.eta(x, y);
    const double e = exact.shell().thickness;
    const Vector3d lower = phi.value + exact.u(x, y).value - e / 2 * (frame.a3 + exact.r(x, y).value);
    EXPECT_NEAR(lower[2], gap, 1e-15);
    EXPECT_GE(gap, 0);
    EXPECT_GE(eta, 0);
    EXPECT_EQ(gap * eta, 0);
    EXPECT_EQ(eta > 0, Manufactured::contact_function(x, y) > 1);
    EXPECT_NEAR(exact.r(x, y).value.dot(frame.a3), 0, 1e-15);
  });
}

TEST(Manufactured, EnergiesOfTheSmoothSolutionAreTheReferenceValues) {
  int count = 0;
  for (const auto& entry : reference("integrals")) {
    if (entry.at("case") != "clamped") continue;
    ++count;
    SCOPED_TRACE(entry.dump());
    for (auto& [name, value] : integrals(solution(entry, entry.at("thickness")), 8)) {
      if (!entry.contains(name)) continue;
      EXPECT_NEAR(value, entry.at(name), 1e-11 * std::abs(entry.at(name).get<double>())) << name;
    }
  }
  EXPECT_EQ(count, 3);
}

// Along the free boundary the energy density is not smooth and the load has a kink. No cell of the rule follows it.
TEST(Manufactured, EnergiesOfTheContactSolutionAreTheReferenceValues) {
  int count = 0;
  for (const auto& entry : reference("integrals")) {
    if (entry.at("case") != "contact") continue;
    ++count;
    SCOPED_TRACE(entry.dump());
    Integrals sum = integrals(solution(entry, entry.at("thickness")), 20);
    for (const char* name : {"E_membrane", "E_bending", "E_shear", "area", "total_reaction"})
      EXPECT_NEAR(sum[name], entry.at(name), 5e-6 * entry.at(name).get<double>()) << name;
    EXPECT_NEAR(sum["load_work"], entry.at("load_work"), 2e-4 * entry.at("load_work").get<double>());
    const double energy = sum["E_membrane"] + sum["E_bending"] + sum["E_shear"];
    EXPECT_NEAR(2 * energy, sum["load_work"] + sum["virtual_gap_work"], 2e-4 * energy);
  }
  EXPECT_EQ(count, 3);
}

}  // namespace plastron::verification
