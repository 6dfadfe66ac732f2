// Measures the distances of 100 000 points by shape of the obstacle, and one factorisation of a shell with about as many nodes: points
// within 0.05 of the surface, as a shell's nodes are, and points anywhere in a box around it.
#include "problems.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/session.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/obstacle/surface_mesh.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <ctime>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace plastron::benchmarks {
namespace {

using geometry::Vector3d;

/// CPU seconds of the calling thread.
double time(const std::function<void()>& call) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  call();
  return now() - start;
}

/// The unit sphere between parallels and meridians.
obstacle::TriangleMesh sphere(int rows) {
  obstacle::TriangleMesh mesh;
  const int columns = 2 * rows;
  const double step = 3.141592653589793 / rows;
  mesh.points.emplace_back(0, 0, 1);
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      mesh.points.emplace_back(std::sin(i * step) * std::cos(j * step), std::sin(i * step) * std::sin(j * step),
                               std::cos(i * step));
  mesh.points.emplace_back(0, 0, -1);
  const int last = static_cast<int>(mesh.points.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
  for (int j = 0; j < columns; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rows - 1, j + 1), at(rows - 1, j)});
    for (int i = 1; i < rows - 1; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

double factorisation(int refinements, std::int64_t& nodes) {
  const problem::Problem problem = cap(0.02, 2, refinements);
  fem::MeshSequence meshes(domain::coarse_mesh(problem.domain, problem.discretisation.cells), 2, MPI_COMM_WORLD);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);
  for (int i = 0; i < refinements; ++i) meshes.refine({});
  nodes = meshes.space()->layout->global_size;
  const assembly::ShellDescription shell{.sections = problem.shell.sections, .supports = problem.shell.supports};
  const auto discrete = assembly::discretise(meshes.space(), surface, shell);
  const algebra::Matrix A = assembly::stiffness_matrix(*discrete);
  algebra::Factorisation F(A);
  const auto held = discrete->coordinates.prescribed();
  return time([&] { F.factorise(held); });
}

using Points = std::vector<Vector3d>;

Points anywhere() {
  std::mt19937 random(1);  // NOLINT: the same points in every run
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  Points points(100000);
  for (Vector3d& X : points) X = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

/// Within 0.05 of the surface, on both sides of it.
Points near(const obstacle::Obstacle& body, Points points) {
  std::mt19937 random(2);  // NOLINT: the same points in every run
  std::uniform_real_distribution<double> off(-0.05, 0.05);
  for (Vector3d& X : points) {
    const obstacle::Nearest at = body.nearest(X);
    X += (off(random) - at.distance) * at.normal;
  }
  return points;
}

obstacle::HeightField formula(const char* text) {
  return obstacle::HeightField(std::make_shared<const geometry::SpaceFunction>(text, geometry::Constants{}));
}

obstacle::HeightField raster() {
  constexpr int n = 401;
  Eigen::MatrixXd heights(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) heights(i, j) = 0.1 * std::cos(0.06 * (i - 200)) * std::cos(0.06 * (j - 200));
  return obstacle::HeightField(std::make_shared<const obstacle::Raster>(heights, Eigen::Vector2d(-2, -2), 0.01));
}

/// Mean distances are printed so that a change of what is computed shows.
void report_shape(const std::string& name, const obstacle::Shape& shape, double factorisation) {
  const obstacle::Obstacle body{.shape = shape};
  const Points box = anywhere();
  const std::array<Points, 2> sets{near(body, box), box};
  fmt::print("{:<36}", name);
  for (const Points& points : sets) {
    double sum = 0;
    const double seconds = time([&] {
      for (const Vector3d& X : points) sum += body.nearest(X).distance;
    });
    fmt::print(" {:8.4f} s {:7.4f} factorisations (mean {:+.6f})", seconds, seconds / factorisation,
               sum / static_cast<double>(points.size()));
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void report() {
  std::int64_t nodes = 0;
  const double one = factorisation(6, nodes);
  fmt::print("one factorisation, {} nodes: {:.2f} s\n{:<36} points near the surface, points anywhere\n", nodes, one,
             "");
  report_shape("half space", obstacle::HalfSpace{}, one);
  report_shape("ball", obstacle::Ball{}, one);
  report_shape("box", obstacle::Box{}, one);
  for (const char* text : {"X^2+Y^2+Z^2-1", "X^2+2*Y^2+Z^2-1"})
    report_shape(fmt::format("expression {}", text),
                 obstacle::DistanceField(std::make_shared<const geometry::SpaceFunction>(text, geometry::Constants{})),
                 one);
  std::optional<obstacle::TriangleSurface> surface;
  const obstacle::TriangleMesh mesh = sphere(224);
  const double seconds = time([&] { surface.emplace(mesh); });
  fmt::print("checks and tree of {} triangles: {:.2f} s, {:.2f} factorisations\n", surface->mesh().triangles.size(),
             seconds, seconds / one);
  report_shape("triangles", *surface, one);
  report_shape("height field of a raster", raster(), one);
  report_shape("height field of a formula", formula("0.1*cos(6*X)*cos(6*Y)"), one);
  report_shape("height field with steep waves", formula("0.1*cos(40*X)*cos(30*Y)"), one);
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv, 1);
  plastron::benchmarks::report();
}
