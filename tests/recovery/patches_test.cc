// Resultants smoothed over patches are exact for polynomials, one order better than those of a cell, and keep jumps.
#include "assembly/sample_shells.hpp"

#include <plastron/domain/domain_mesh.hpp>
#include <plastron/recovery/recovery.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace plastron::recovery {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
/// u and r, and their derivatives along x and y, at a point of Omega.
struct FieldJet {
  Vector6 value, d1, d2;
};
using Field = std::function<FieldJet(const Eigen::Vector2d&)>;
const std::vector<Eigen::Vector2d> samples{{0.1, 0.2}, {0.3, 0.3}, {0.6, 0.05}, {0.2, 0.75}, {0, 0}};

struct Interpolated {
  Interpolated(const test::MeshedSurface& m, const Field& field, const energy::CrossSections& sections,
               bool tying = true)
      : discrete(assembly::discretise(m.space, m.surface, {.sections = sections, .tying = tying})),
        solution{algebra::Vector(m.space->layout, 6), algebra::Vector(m.space->layout, 1),
                 algebra::Vector(m.space->layout, 1)} {
    for (std::size_t i = 0; i < discrete->points.size(); ++i) {
      const Vector6 y = field(discrete->points[i].x).value;
      for (std::size_t k = 0; k < 6; ++k) solution.y.local()[6 * i + k] = y[static_cast<Eigen::Index>(k)];
    }
  }
  std::vector<PointValues> values(bool smooth, std::optional<Vector3d> axis = {}) const {
    Choice choice{.axis = axis};
    if (smooth) choice.patches = std::make_shared<ResultantPatches>(*discrete, solution);
    std::vector<PointValues> all;
    const Recovery recovery(*discrete, solution, samples, choice);
    for (std::size_t c = 0; c < discrete->space().owned_cells; ++c)
      for (const PointValues& p : recovery(c)) all.push_back(p);
    return all;
  }

  std::unique_ptr<assembly::DiscreteShell> discrete;
  NodalSolution solution;
};

Resultants resultants_of(const PointValues& p) {
  Resultants r;
  r << p.N.transpose(), p.M.transpose(), p.Q.transpose();
  return r;
}

/// (M4-M8) at a point of Omega, in the point's axes.
Resultants exact(const geometry::Chart& chart, const Field& field, const PointValues& p) {
  const geometry::Frame frame = geometry::frame_at(chart(p.x[0], p.x[1]));
  const FieldJet y = field(p.x);
  const shell::LocalField<double> local{
      .du = {y.d1.head<3>(), y.d2.head<3>()}, .r = y.value.tail<3>(), .dr = {y.d1.tail<3>(), y.d2.tail<3>()}};
  const auto s = shell::resultants(shell::section_at(p.material, frame, p.thickness), shell::strain(local, frame));
  Eigen::Matrix2d to_axes;
  to_axes << frame.a_cov[0].dot(p.t1), frame.a_cov[1].dot(p.t1), frame.a_cov[0].dot(p.t2), frame.a_cov[1].dot(p.t2);
  Resultants contravariant;
  contravariant << s.membrane.transpose(), s.bending.transpose(), s.shear.transpose();
  return in_other_axes(contravariant, to_axes);
}

/// Largest error over all points and ranks of a resultant, over the largest value of its kind.
double error(const std::vector<PointValues>& points, const geometry::Chart& chart, const Field& field) {
  std::array<double, 3> worst{}, size{};
  constexpr std::array<Eigen::Index, 4> begin{0, 3, 6, 8};
  for (const PointValues& p : points) {
    const Resultants wanted = exact(chart, field, p), got = resultants_of(p);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto part = [&](const Resultants& r) { return r.segment(begin[k], begin[k + 1] - begin[k]); };
      worst[k] = std::fmax(worst[k], (part(got) - part(wanted)).norm());
      size[k] = std::fmax(size[k], part(wanted).norm());
    }
  }
  double relative = 0;
  for (std::size_t k = 0; k < 3; ++k)
    relative = std::max(
        relative, algebra::max_over_ranks(worst[k], MPI_COMM_WORLD) / algebra::max_over_ranks(size[k], MPI_COMM_WORLD));
  return relative;
}

/// All terms x^i y^j with i + j <= degree, each field with different ones.
Field polynomial(int degree) {
  return [degree](const Eigen::Vector2d& x) {
    FieldJet y{Vector6::Zero(), Vector6::Zero(), Vector6::Zero()};
    for (int c = 0; c < 6; ++c)
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j) {
          const double a = std::sin(1.0 + 3 * c + 5 * i + 7 * j);
          y.value[c] += a * std::pow(x[0], i) * std::pow(x[1], j);
          if (i > 0) y.d1[c] += a * i * std::pow(x[0], i - 1) * std::pow(x[1], j);
          if (j > 0) y.d2[c] += a * j * std::pow(x[0], i) * std::pow(x[1], j - 1);
        }
    return y;
  };
}

FieldJet nothing(const Eigen::Vector2d&) { return {Vector6::Zero(), Vector6::Zero(), Vector6::Zero()}; }

FieldJet smooth_field(const Eigen::Vector2d& x) {
  FieldJet y;
  for (int c = 0; c < 6; ++c) {
    const double a = 1.1 + 0.3 * c, b = 0.7 - 0.2 * c, phase = a * x[0] + b * x[1] + c;
    y.value[c] = std::sin(phase);
    y.d1[c] = a * std::cos(phase);
    y.d2[c] = b * std::cos(phase);
  }
  return y;
}

// Parallelograms ten times as long as wide, with angles of 45 degrees, as in rows along the edges of a saddle.
TEST(Patches, JudgeEveryCellOfLongThinObliqueOnes) {
  for (const int degree : {3, 4, 6}) {
    const auto m = test::meshed(domain::Rectangle{.to = {1, 0.1}}, {"x", "x + y", "0"}, degree, 2);
    const Interpolated plate(m, nothing, test::steel_of(geometry::Expression(0.01)));
    const ResultantPatches patches(*plate.discrete, plate.solution, degree + degree / 2);
    for (std::size_t c = 0; c < plate.discrete->space().owned_cells; ++c)
      EXPECT_TRUE(patches.has_patch(c)) << "degree " << degree << ", cell " << c;
  }
}

// Interpolants of polynomials of degree k + 1 have exact derivatives at the resultant points of rectangles. The polynomials of the patches
// continue them everywhere, also to the corners. The shear strain contains r itself, of degree k.
TEST(Patches, AreExactForFieldsOfOneDegreeMoreThanTheElements) {
  const geometry::Chart chart(test::flat, {});
  for (int degree = 1; degree <= 4; ++degree) {
    const auto m = test::meshed(domain::Rectangle{}, test::flat, degree, 2);
    const Field whole = polynomial(degree + 1);
    const Field field = [&](const Eigen::Vector2d& x) {
      FieldJet y = whole(x);
      y.value.tail<3>().setZero();
      y.d1.tail<3>().setZero();
      y.d2.tail<3>().setZero();
      y.value[2] = y.d1[2] = y.d2[2] = 0;
      return y;
    };
    const Interpolated plate(m, field, test::steel_of(geometry::Expression(0.1)));
    double worst_smooth = 0, worst_raw = 0, size = 0;
    const auto smooth = plate.values(true), raw = plate.values(false);
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      const Resultants wanted = exact(chart, field, smooth[i]);
      worst_smooth = std::max(worst_smooth, (resultants_of(smooth[i]) - wanted).norm());
      worst_raw = std::max(worst_raw, (resultants_of(raw[i]) - wanted).norm());
      size = std::max(size, wanted.norm());
    }
    EXPECT_LT(worst_smooth, 1e-11 * size) << degree;
    EXPECT_GT(algebra::max_over_ranks(worst_raw, MPI_COMM_WORLD), 1e-5 * size) << degree;
  }
}

// One row of cells has as many rows of points as their degree, and all its vertices are on edges.
TEST(Patches, OfOneRowOfCellsAreExactAlongIt) {
  const geometry::Chart chart(test::flat, {});
  for (int degree = 2; degree <= 4; ++degree)
    for (const bool is_tall : {false, true}) {
      domain::Rectangle strip{.to = {1, 0.25}, .cells = {6, 1}};
      if (is_tall) strip = {.to = {0.25, 1}, .cells = {1, 6}};
      const auto m = test::meshed(strip, test::flat, degree, 0);
      const int along = is_tall ? 1 : 0;
      const Field field = [&](const Eigen::Vector2d& x) {
        FieldJet y{};
        y.value.setZero();
        y.d1.setZero();
        y.d2.setZero();
        y.value[along] = std::pow(x[along], degree + 1);
        (along == 0 ? y.d1 : y.d2)[along] = (degree + 1) * std::pow(x[along], degree);
        return y;
      };
      const Interpolated plate(m, field, test::steel_of(geometry::Expression(0.1)));
      const auto values = plate.values(true);
      double size = 0;
      for (const PointValues& p : values) size = std::max(size, exact(chart, field, p).norm());
      for (const PointValues& p : values) {
        const Resultants wanted = exact(chart, field, p);
        EXPECT_LT((resultants_of(p) - wanted).norm(), 1e-10 * size) << degree << " at " << p.x.transpose();
      }
      EXPECT_TRUE(ResultantPatches(*plate.discrete, plate.solution).has_patch(0));
    }
}

double rate(mesh::Shape shape, int degree, bool smooth, int coarse) {
  const geometry::Chart chart(test::saddle, {});
  std::array<double, 2> errors{};
  for (int level = 0; level < 2; ++level) {
    const auto m = test::meshed(domain::Rectangle{}, test::saddle, degree, coarse + level, shape);
    const Interpolated shell(m, smooth_field, test::steel_of(geometry::Expression("0.1 + 0.02*x", {})));
    errors[static_cast<std::size_t>(level)] = error(shell.values(smooth), chart, smooth_field);
  }
  return std::log2(errors[0] / errors[1]);
}

TEST(Patches, GainAnOrderOverTheResultantsOfACell) {
  for (int degree = 1; degree <= 3; ++degree) {
    EXPECT_GT(rate(test::quadrilateral, degree, true, 3), degree + 0.75) << degree;
    EXPECT_LT(rate(test::quadrilateral, degree, false, 3), degree + 0.4) << degree;
  }
}

TEST(Patches, OfOneFieldServeAnother) {
  const auto m = test::meshed(domain::Rectangle{}, {"x", "y", "x*y + x^2/2"}, 3, 2);
  const Interpolated still(m, nothing, test::steel_of(geometry::Expression(0.1)));
  const Interpolated moved(m, smooth_field, test::steel_of(geometry::Expression(0.1)));
  const ResultantPatches of_still(*still.discrete, still.solution);
  const auto values = [&](std::shared_ptr<const ResultantPatches> patches) {
    return Recovery(*moved.discrete, moved.solution, samples, {.patches = std::move(patches)});
  };
  const Recovery own = values(std::make_shared<ResultantPatches>(*moved.discrete, moved.solution));
  const Recovery shared =
      values(std::make_shared<ResultantPatches>(*moved.discrete, moved.solution.y, of_still.patches()));
  for (std::size_t c = 0; c < m.space->owned_cells; ++c) {
    const auto a = own(c), b = shared(c);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(resultants_of(a[i]), resultants_of(b[i]));
  }
}

TEST(Patches, WorkOnTriangles) {
  for (int degree = 1; degree <= 2; ++degree) {
    const geometry::Chart chart(test::saddle, {});
    const auto m = test::meshed(domain::Rectangle{}, test::saddle, degree, 4, test::triangle);
    const Interpolated shell(m, smooth_field, test::steel_of(geometry::Expression(0.1)));
    EXPECT_LT(error(shell.values(true), chart, smooth_field), 0.4 * error(shell.values(false), chart, smooth_field))
        << degree;
  }
}

TEST(Patches, TheInvariantsOfTensorsDoNotDependOnTheFrame) {
  const auto m = test::meshed(domain::Disk{.radius = 0.8}, test::cap, 2, 2);
  const Interpolated shell(m, smooth_field, test::steel_of(geometry::Expression(0.1)));
  for (const bool smooth : {true, false}) {
    const auto reference = shell.values(smooth);
    for (const Vector3d& axis : {Vector3d(0, 1, 0), Vector3d(1, 2, 3), Vector3d(0, 0, 1)}) {
      const auto turned = shell.values(smooth, axis);
      for (std::size_t i = 0; i < reference.size(); ++i) {
        const auto a = shell::principal(reference[i].M), b = shell::principal(turned[i].M);
        EXPECT_NEAR(a.first, b.first, 1e-13);
        EXPECT_NEAR(a.second, b.second, 1e-13);
        EXPECT_NEAR(reference[i].Q.norm(), turned[i].Q.norm(), 1e-13);
        const Vector3d direction = std::cos(a.angle) * reference[i].t1 + std::sin(a.angle) * reference[i].t2;
        const Vector3d other = std::cos(b.angle) * turned[i].t1 + std::sin(b.angle) * turned[i].t2;
        if (a.first - a.second > 1e-6) {
          EXPECT_NEAR(std::abs(direction.dot(other)), 1, 1e-7);
        }
        EXPECT_NEAR(turned[i].t2.dot(axis), 0, axis == Vector3d(0, 0, 1) ? 2e-6 : 1e-12);
      }
    }
  }
}

// One strain, two thicknesses: forces jump from 1 to 2 where the regions meet, without values in between.
TEST(Patches, DoNotSmearAJumpOfTheThickness) {
  fem::MeshSequence meshes(
      domain::coarse_mesh(domain::Rectangle{.breaks = {0.5}, .regions = {"thin", "thick"}}, test::quadrilateral), 2,
      MPI_COMM_WORLD);
  for (int i = 0; i < 2; ++i) meshes.refine({});
  std::map<std::string, geometry::Chart> charts;
  for (const char* region : {"thin", "thick"}) charts.emplace(region, geometry::Chart(test::flat, {}));
  const test::MeshedSurface m{meshes.space(), std::make_shared<const fem::Surface>(meshes.space()->coarse, charts)};
  energy::CrossSections sections = test::steel_of(geometry::Expression(0.1));
  sections.regions["thick"] = {.thickness = geometry::Expression(0.2), .material = test::steel_like()};
  const Field stretch = [](const Eigen::Vector2d& x) {
    FieldJet y{Vector6::Zero(), Vector6::Zero(), Vector6::Zero()};
    y.value[0] = x[0];
    y.d1[0] = 1;
    return y;
  };
  const Interpolated plate(m, stretch, sections);
  const geometry::Chart chart(test::flat, {});
  const auto points = plate.values(true);
  for (const PointValues& p : points) EXPECT_LT((resultants_of(p) - exact(chart, stretch, p)).norm(), 1e-12);
}

}  // namespace
}  // namespace plastron::recovery
