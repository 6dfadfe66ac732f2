// Loads at places: conditions, spots around points, sums of forces and moments. Closed forms and balances.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using nlohmann::json;
using std::numbers::pi;

json results_of(const Scratch& scratch, const std::string& text) {
  scratch.write("case.toml", text);
  const Outcome run = plastron({"run", "case.toml", "--output", "out", "--no-report"}, scratch.path, 120);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return json::parse(text_of(scratch.path / "out" / "results.json"));
}

/// Energy of a simply supported unit square of Reissner's plate under a force that is spread over a rectangle: Navier's series.
double navier(double E, double nu, double e, double force, double x, double y, double width, double height) {
  const double D = E * e * e * e / (12 * (1 - nu * nu)), S = 5. / 6 * E / (2 * (1 + nu)) * e;
  const auto part = [](int m, double at, double size) {
    return 2 / (m * pi) * std::sin(m * pi * at) * std::sin(m * pi * size / 2);
  };
  double energy = 0;
  constexpr int terms = 1500;
  for (int m = 1; m <= terms; ++m)
    for (int n = 1; n <= terms; ++n) {
      const double k = pi * pi * (m * m + n * n);
      const double q = 4 * force / (width * height) * part(m, x, width) * part(n, y, height);
      energy += q * q * (1 / (D * k * k) + 1 / (S * k)) / 8;
    }
  return energy;
}

/// Rectangles at random places, smaller and larger than cells.
TEST(LoadedPlaces, ARectangleOnAPlateIsNaviers) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(0, 1);
  for (const double size : {0.02, 0.1, 0.3}) {
    const double x = 0.3 + 0.4 * part(random), y = 0.3 + 0.4 * part(random), width = size * (1 + part(random)),
                 height = size * (1 + part(random));
    const Scratch scratch;
    const std::string text =
        "[shell]\nE = 2.1e11\nnu = 0.3\nthickness = 0.02\nshear_correction = \"5/6\"\n[geometry]\ndomain = { rectangle "
        "= "
        "{ to = [1, 1] } }\nchart = [\"x\", \"y\", \"0\"]\n[accuracy]\nenergy = 1e-4\n"
        "[[support]]\nboundary = [\"left\", \"right\"]\nfix = [\"u\", \"r.y\"]\n"
        "[[support]]\nboundary = [\"bottom\", \"top\"]\nfix = [\"u\", \"r.x\"]\n[[load]]\n" +
        fmt::format("where = \"abs(X - {:.12g}) < {:.12g} && abs(Y - {:.12g}) < {:.12g}\"\n", x, width / 2, y,
                    height / 2) +
        "total = [0, 0, 1000]\n";
    const json results = results_of(scratch, text);
    const double exact = navier(2.1e11, 0.3, 0.02, 1000, x, y, width, height);
    EXPECT_NEAR(results["energy"].get<double>(), exact, 1e-4 * exact) << text;
    EXPECT_NEAR(results["loads"]["force"][2].get<double>(), 1000, 1e-9);
  }
}

/// Sums of force and moment about the point on plane and curved shells, quadrilaterals and triangles, charts and meshes.
TEST(LoadedPlaces, ForceAndMomentAreThoseOfTheCase) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1, 1);
  const Scratch scratch;
  const std::string rectangle = "domain = { rectangle = { from = [-1, -1], to = [1, 1], cells = [4, 4] } }\n";
  const std::vector<std::pair<std::string, std::string>> shapes{
      {rectangle + "chart = [\"x\", \"y\", \"0\"]\n", ""},
      {rectangle + "chart = [\"2*sin(x/2)\", \"y\", \"2*cos(x/2)\"]\n", ""},
      {rectangle + "chart = [\"2*sin(x/2)\", \"y\", \"2*cos(x/2)\"]\n", "cells = \"triangle\"\n"},
      {rectangle + "chart = [\"x\", \"y\", \"0.3*x*y\"]\n", ""}};
  for (const auto& [geometry, mesh] : shapes) {
    const double x = 0.7 * part(random), y = 0.7 * part(random);
    const double e = 0.02;
    for (const double radius : {0.02, 0.4}) {
      // The centroid of a large spot is not known, so it has a moment alone.
      const std::array<double, 3> M{part(random), part(random), part(random)};
      const std::array<double, 3> F =
          radius > 0.1 ? std::array<double, 3>{} : std::array{part(random), part(random), part(random)};
      const json results = results_of(
          scratch,
          fmt::format(
              "[shell]\nE = 1e6\nnu = 0.3\nthickness = {}\n[geometry]\n{}[[support]]\nboundary = \"left\"\nfix = "
              "[\"u\", \"r\"]\n[[load]]\npoint = [{}, {}]\nradius = {}\ntotal = [{}, {}, {}]\nmoment = [{}, {}, {}]\n"
              "[[probe]]\nname = \"p\"\nat = [{}, {}]\n[mesh]\nrefinements = 1\n{}",
              e, geometry, x, y, radius, F[0], F[1], F[2], M[0], M[1], M[2], x, y, mesh));
      const json& place = results["probes"]["p"]["position"];
      const std::array<double, 3> p{place[0], place[1], place[2]};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        EXPECT_NEAR(results["loads"]["force"][k].get<double>(), F[k], 1e-9);
        EXPECT_NEAR(results["loads"]["moment"][k].get<double>(), M[k] + p[i] * F[j] - p[j] * F[i],
                    radius > 0.1 ? 1e-9 : 1e-3)
            << geometry << radius;
        EXPECT_NEAR(results["support_reaction"]["force"][k].get<double>(), -F[k], 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace plastron::cli
