// Axes, patches of 3 x 3 cells, singular corners by angle and supports, and the largest stresses against a search of all points.
#include <gtest/gtest.h>
#include <plastron/mesh/basis.hpp>
#include <plastron/recovery/layer_stresses.hpp>
#include <plastron/recovery/recovery.hpp>
#include <plastron/recovery/singular_places.hpp>
#include <plastron/recovery/stress_peak.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "solution/scenes.hpp"

namespace plastron::recovery::places_and_peaks_test {
namespace {

using namespace plastron::test;

constexpr double degrees = std::numbers::pi / 180;
const std::array<std::string, 3> bent{"x + 0.1*y", "y", "0.3 + 0.2*x*y + 0.1*x^2"};

SurfaceAxes drawn_axes(Random& random) {
  const Vector3d a3 = drawn_vector(random).normalized();
  return surface_axes(a3.unitOrthogonal(), a3, drawn_vector(random));
}

// Components of tensors change as those of matrices do; changes go back; weights are transposed.
TEST(SurfaceAxes, ChangeComponentsAsRotationsDo) {
  Random random(1);
  for (int draw = 0; draw < 100; ++draw) {
    const SurfaceAxes from = drawn_axes(random);
    SurfaceAxes to = drawn_axes(random);
    if (to.a3.dot(from.a3) < 0) to = {to.t1, -to.t2, -to.a3};
    for (const SurfaceAxes& axes : {from, to}) {
      Eigen::Matrix3d basis;
      basis << axes.t1, axes.t2, axes.a3;
      EXPECT_LT((basis.transpose() * basis - Eigen::Matrix3d::Identity()).norm(), 1e-14);
      EXPECT_NEAR(basis.determinant(), 1, 1e-14);
    }
    const Eigen::Matrix3d turn = shortest_turn(from.a3, to.a3);
    EXPECT_LT((turn * from.a3 - to.a3).norm(), 1e-13);
    EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_NEAR((turn.trace() - 1) / 2, from.a3.dot(to.a3), 1e-13);  // no larger angle than between the normals
    const Eigen::Matrix2d change = change_of_axes(from, to);
    EXPECT_LT((change * change_of_axes(to, from) - Eigen::Matrix2d::Identity()).norm(), 1e-13);
    const Vector3d tensor = drawn_vector(random), other = in_other_axes(tensor, change);
    const auto matrix = [](const Vector3d& t) { return (Eigen::Matrix2d() << t[0], t[2], t[2], t[1]).finished(); };
    EXPECT_LT((matrix(other) - change * matrix(tensor) * change.transpose()).norm(), 1e-14);
    const Resultants values = Resultants::NullaryExpr([&] { return drawn(random); }),
                     weights = Resultants::NullaryExpr([&] { return drawn(random); });
    EXPECT_NEAR(weights.dot(in_other_axes(values, change)), in_other_axes_transposed(weights, change).dot(values),
                1e-13);
  }
  // The given axis is projected; along the normal the tangent decides.
  const Vector3d normal = Vector3d::UnitZ(), tangent = Vector3d::UnitY();
  EXPECT_LT((surface_axes(tangent, normal, Vector3d(3, 4, 9)).t1 - Vector3d(0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_LT((surface_axes(tangent, normal, Vector3d(1e-8, 0, 1)).t1 - tangent).norm(), 1e-15);
}

std::unique_ptr<assembly::DiscreteShell> shell_of(const MeshedSurface& m, assembly::ShellDescription shell = {}) {
  shell.sections = steel_of(geometry::Expression(0.1));
  return assembly::discretise(m.space, m.surface, shell);
}
NodalSolution solution_of(const assembly::DiscreteShell& discrete, algebra::Vector y) {
  const auto& layout = discrete.space().layout;
  return {.y = std::move(y), .pressure = algebra::Vector(layout, 1), .touching = algebra::Vector(layout, 1)};
}
algebra::Vector drawn_motion(const assembly::DiscreteShell& discrete, Random& random) {
  algebra::Vector y(discrete.space().layout, 6);
  for (double& value : y.local()) value = drawn(random);
  return y;
}

std::vector<CellResultants> points_of(const assembly::DiscreteShell& discrete) {
  const ResultantPoints points(discrete, assembly::FieldKind::motion);
  std::vector<CellResultants> cells;
  const algebra::Vector zero(discrete.space().layout, 6);
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    cells.push_back(points(c, discrete.shell.gather(c, zero)));
  return cells;
}

// Nine cells have 16 vertices. The four vertices inside have full patches. Their planes map all points of their cells into a square.
// Fits of polynomials return their coefficients. Every cell has an inner vertex.
TEST(Patches, OfNineCellsAreFullAtTheirInnerVerticesAndReproducePolynomials) {
  Random random(2);
  for (const int degree : {1, 2, 3, 5}) {
    const MeshedSurface m = meshed(domain::Rectangle{.to = {1.2, 0.9}, .cells = {3, 3}}, bent, degree, 0);
    const auto discrete = shell_of(m);
    const std::vector<CellResultants> cells = points_of(*discrete);
    const Patches patches(*discrete, cells, degree);
    EXPECT_EQ(patches.terms(), (degree + 1) * (degree + 2) / 2);
    std::map<algebra::LocalIndex, int> points;
    std::map<algebra::LocalIndex, Eigen::MatrixXd> right;
    const Eigen::VectorXd coefficients = Eigen::VectorXd::NullaryExpr(patches.terms(), [&] { return drawn(random); });
    patches.for_points(cells, [&](algebra::LocalIndex vertex, const Patches::Plane& plane, const CellResultants& cell,
                                  std::size_t p) {
      ++points[vertex];
      const Vector3d way = cell.position[p] - plane.position;
      const Eigen::Vector2d square = plane.to_square * Eigen::Vector2d(way.dot(plane.axes.t1), way.dot(plane.axes.t2));
      EXPECT_LT(square.cwiseAbs().maxCoeff(), 1.15) << "degree " << degree;
      EXPECT_TRUE(patches.reaches(plane, cell.axes[p]));
      const Patches::Terms terms = patches.basis(plane, cell.position[p]);
      EXPECT_NEAR(terms[0], 1, 1e-15);
      Eigen::MatrixXd& sum = right.try_emplace(vertex, Eigen::MatrixXd::Zero(patches.terms(), 1)).first->second;
      sum += terms.transpose() * (terms * coefficients);
    });
    int full = 0;
    for (const auto& [vertex, count] : points) {
      if (patches.kind(vertex) != Patches::Kind::full) continue;
      ++full;
      EXPECT_EQ(count, 4 * degree * degree);
      EXPECT_LT((patches.solve(vertex, right.at(vertex)) - coefficients).norm(), 1e-8) << "degree " << degree;
    }
    EXPECT_EQ(full, 4);
    for (std::size_t c = 0; c < cells.size(); ++c) EXPECT_EQ(patches.best(c), Patches::Kind::full);
  }
}

// No patch crosses a border of regions: of the columns of three cells each, only the vertices beside no border have one.
TEST(Patches, DoNotCrossTheBordersOfRegions) {
  const domain::Rectangle two{.to = {1.2, 0.9}, .cells = {4, 3}, .breaks = {0.6}, .regions = {"a", "b"}};
  fem::MeshSequence meshes(domain::coarse_mesh(two, quadrilateral), 2, MPI_COMM_WORLD);
  std::map<std::string, geometry::Chart> charts;
  for (const char* region : {"a", "b"}) charts.emplace(region, geometry::Chart(bent, {}));
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, charts);
  const auto discrete = shell_of({meshes.space(), surface});
  const std::vector<CellResultants> cells = points_of(*discrete);
  const Patches patches(*discrete, cells, 2);
  std::map<algebra::LocalIndex, std::vector<double>> places;
  patches.for_points(cells, [&](algebra::LocalIndex vertex, const Patches::Plane&, const CellResultants& cell,
                                std::size_t p) { places[vertex].push_back(cell.position[p][0]); });
  EXPECT_FALSE(places.empty());
  for (const auto& [vertex, x] : places) {
    const auto [least, most] = std::ranges::minmax(x);
    // x = x_1 + 0.1 x_2: the border is at 0.6 to 0.69.
    EXPECT_TRUE(most < 0.69 || least > 0.6);
  }
}

// f . v = weights . at(...) for every motion v.
TEST(ResultantPatches, HaveTransposedForces) {
  Random random(3);
  for (const mesh::Shape shape : {quadrilateral, triangle}) {
    const MeshedSurface m = meshed(domain::Rectangle{.cells = {3, 3}}, bent, 2, 0, shape);
    const auto discrete = shell_of(m);
    const algebra::Vector v = drawn_motion(*discrete, random);
    const ResultantPatches patches(*discrete, solution_of(*discrete, v));
    for (int draw = 0; draw < 4; ++draw) {
      ResultantPatches::Weighed point{.cell = drawn_number(random, static_cast<unsigned>(m.space->owned_cells - 1)),
                                      .xi = {drawn(random, 0, 0.5), drawn(random, 0, 0.5)}};
      ASSERT_TRUE(patches.has_patch(point.cell));
      const geometry::Frame frame = m.surface->frame(m.space->cells[point.cell], point.xi, false);
      point.position = frame.phi;
      point.axes = surface_axes(frame.a_cov[0], frame.a3, drawn_vector(random));
      point.weights = Resultants::NullaryExpr([&] { return drawn(random); });
      algebra::Vector f(m.space->layout, 6);
      patches.add_transposed(*discrete, point, f);
      const double expected = point.weights.dot(*patches.at(point.cell, point.xi, point.position, point.axes));
      double sum = 0, size = 0;
      for (std::size_t i = 0; i < f.local().size(); ++i) {
        sum += f.local()[i] * v.local()[i];
        size += std::abs(f.local()[i] * v.local()[i]);
      }
      EXPECT_NEAR(sum, expected, 1e-11 * size);
      EXPECT_GT(std::abs(expected), 1e-9 * size);
    }
  }
}

/// A polygon whose first corner, at the origin, has this angle. Its first edge starts there, and its last one ends there.
domain::Polygon with_angle(double angle) {
  domain::Polygon polygon{{{0, 0}}};
  for (int k = 0; k <= 3; ++k) {
    const double at = angle * k / 3;
    polygon.corners.emplace_back(std::cos(at), std::sin(at));
  }
  return polygon;
}

struct Hold {
  unsigned first, last;  ///< components of u on both edges, in bits x, y, z; 8: rotations, too
  double bounded;        ///< largest angle of bounded stresses [degrees]
};

// Stresses at a corner are bounded up to an angle that the supports of both edges decide. The others' corners are clamped on
// both sides and below 180 degrees.
TEST(SingularPlaces, AreCornersAboveTheAngleOfTheirSupports) {
  const auto components = [](unsigned hold) { return (hold & 7U) | (hold >= 8 ? 56U : 0U); };
  for (const Hold& hold : {Hold{15, 15, 180}, Hold{0, 0, 180}, Hold{15, 0, 63}, Hold{0, 15, 63}, Hold{4, 0, 90},
                           Hold{4, 4, 180}, Hold{7, 4, 63}})
    for (const double angle : {45.0, 60.0, 80.0, 110.0, 150.0, 200.0, 270.0}) {
      std::vector<assembly::Support> supports;
      for (int k = 2; k <= 4; ++k) supports.push_back(held("edge" + std::to_string(k), 63));
      if (hold.first != 0) supports.push_back(held("edge1", components(hold.first)));
      if (hold.last != 0) supports.push_back(held("edge5", components(hold.last)));
      const auto discrete = shell_of(meshed(with_angle(angle * degrees), flat, 1, 0), {.supports = supports});
      const NodalSolution zero = solution_of(*discrete, algebra::Vector(discrete->space().layout, 6));
      solution::Summary summary;
      summary.size = 1;
      const auto places = singular_places(*discrete, zero, summary);
      const bool is_found = std::ranges::any_of(
          places, [](const SingularPlace& place) { return place.position.head<2>().norm() < 1e-12; });
      EXPECT_EQ(is_found, angle > hold.bounded + 8.7) << hold.first << " and " << hold.last << " at " << angle;
      for (const SingularPlace& place : places) EXPECT_EQ(place.radius, 0.1);
    }
}

// The place of the largest stress among all lattice points that are near no singular place, found again by a loop over them.
TEST(StressPeak, IsTheLargestOfAllPointsAwayFromSingularPlaces) {
  Random random(4);
  for (const int degree : {1, 2, 3}) {
    const MeshedSurface m = meshed(domain::Rectangle{.cells = {3, 3}}, bent, degree, 0);
    const auto discrete = shell_of(m);
    const NodalSolution nodal = solution_of(*discrete, drawn_motion(*discrete, random));
    const Recovery recovery(*discrete, nodal, mesh::lattice(quadrilateral, degree));
    std::vector<SingularPlace> singular;
    double before = std::numeric_limits<double>::infinity();
    for (int draw = 0; draw < 5; ++draw) {
      double most = 0;
      for (std::size_t c = 0; c < m.space->owned_cells; ++c)
        for (const PointValues& point : recovery(c)) {
          if (is_singular(point.phi, singular)) continue;
          for (const double z : {-0.05, -0.02, 0.0, 0.02, 0.05})
            most = std::max(most, shell::von_mises_at(section_forces(point), z));
        }
      const StressPeak peak = stress_peak(*discrete, nodal, {}, singular);
      EXPECT_GE(peak.von_mises, (1 - 1e-9) * most);
      EXPECT_LE(peak.von_mises, (1 + 1e-9) * before);  // equal ones are ordered by place
      EXPECT_FALSE(is_singular(peak.position, singular));
      const PointValues there = Recovery(*discrete, nodal, {peak.xi})(peak.cell).front();
      EXPECT_NEAR(shell::von_mises_at(section_forces(there), peak.height), peak.von_mises, 1e-12 * peak.von_mises);
      EXPECT_LT((there.phi - peak.position).norm(), 1e-14);
      EXPECT_TRUE(std::isnan(peak.error));  // without patches
      before = peak.von_mises;
      singular.push_back({.position = peak.position, .radius = 0.2});
    }
    singular.push_back({.radius = 10});
    EXPECT_EQ(stress_peak(*discrete, nodal, {}, singular).von_mises, 0);
  }
}

// A laminate of one material is that material: in-plane stresses are linear over the thickness, and transverse shear is a parabola. Each
// layer's extremes are at its interfaces, at drawn parts of the thickness.
TEST(LayerStresses, OfOneMaterialAreThoseOfAHomogeneousPlate) {
  Random random(5);
  constexpr double E = 2, nu = 0.25, e = 0.1, stretch = 1e-3, curvature = 2e-2, slide = 3e-3, shear_correction = 0.8;
  for (int draw = 0; draw < 4; ++draw) {
    const std::vector<double> parts{drawn(random, 0.2, 1), drawn(random, 0.2, 1), drawn(random, 0.2, 1)};
    std::vector<shell::Layer> layers;
    for (const double part : parts) layers.push_back({.material = shell::Orthotropic::isotropic(E, nu), .part = part});
    const MeshedSurface m = meshed(domain::Rectangle{.cells = {3, 3}}, flat, 2, 0);
    assembly::ShellDescription description{};
    description.sections.common.thickness = geometry::Expression(e);
    description.sections.common.material.law = std::make_shared<const shell::Laminate>(layers, Vector3d::UnitX());
    description.sections.common.material.shear_correction = shear_correction;
    const auto discrete = assembly::discretise(m.space, m.surface, description);
    // u_1 = stretch x, u_3 = -curvature x^2/2 + slide y, r_1 = curvature x.
    const NodalSolution nodal = solution_of(*discrete, interpolant(discrete->shell, [&](const assembly::NodalPoint& p) {
      Eigen::Matrix<double, 6, 1> y = Eigen::Matrix<double, 6, 1>::Zero();
      y[0] = stretch * p.x[0];
      y[2] = -curvature * p.x[0] * p.x[0] / 2 + slide * p.x[1];
      y[3] = curvature * p.x[0];
      return y;
    }));
    const auto all = layer_stresses(*discrete, nodal, {.axis = Vector3d::UnitX()}, {});
    ASSERT_EQ(all.size(), 15U);
    const double sum = parts[0] + parts[1] + parts[2], shear_modulus = E / (2 * (1 + nu));
    std::vector<double> interfaces{-e / 2};
    for (const double part : parts) interfaces.push_back(interfaces.back() + e * part / sum);
    const auto stress = [&](double z) { return E / (1 - nu * nu) * (stretch + z * curvature); };
    const auto shear = [&](double z) {
      return shear_correction * shear_modulus * slide * 1.5 * (1 - std::pow(2 * z / e, 2));
    };
    for (const LayerStress& layer : all) {
      const double low = interfaces[static_cast<std::size_t>(layer.layer - 1)],
                   high = interfaces[static_cast<std::size_t>(layer.layer)], size = stress(e / 2);
      const auto expect = [&](double most, double least) {
        EXPECT_NEAR(layer.most.stress, most, 1e-9 * size) << layer.layer << ", " << layer.component;
        EXPECT_NEAR(layer.least.stress, least, 1e-9 * size) << layer.layer << ", " << layer.component;
      };
      if (layer.component == "11" || layer.component == "22") {
        const double factor = layer.component == "11" ? 1 : nu;
        expect(factor * stress(high), factor * stress(low));
        EXPECT_NEAR(layer.most.height, high, 1e-15);
        EXPECT_NEAR(layer.least.height, low, 1e-15);
      } else if (layer.component == "23") {
        const double middle = (low + high) / 2;
        expect(std::max({shear(low), shear(middle), shear(high)}), std::min({shear(low), shear(middle), shear(high)}));
      } else {
        expect(0, 0);
      }
    }
  }
}

}  // namespace
}  // namespace plastron::recovery::places_and_peaks_test
