// What the distance of 100 000 points costs by shape of the obstacle, beside one factorisation of a shell with about as many nodes.
#include "cap.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/session.hpp>
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/computation/gap.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/obstacle/surface_mesh.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <ctime>
#include <functional>
#include <random>
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
  const computation::Problem problem = cap(0.02, 2, refinements);
  fem::MeshSequence meshes(fem::coarse_mesh(problem.domain, problem.discretisation.cells), 2, MPI_COMM_WORLD);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);
  for (int i = 0; i < refinements; ++i) meshes.refine({});
  nodes = meshes.space()->layout->global_size;
  const assembly::ShellDescription shell{.sections = problem.sections, .supports = problem.supports};
  const auto discrete = assembly::discretise(meshes.space(), surface, shell);
  const algebra::Matrix A = assembly::stiffness_matrix(*discrete);
  algebra::Factorisation F(A);
  const auto held = discrete->coordinates.prescribed();
  return time([&] { F.factorise(held); });
}

void report() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  std::vector<Vector3d> points(100000);
  for (Vector3d& X : points) X = {coordinate(random), coordinate(random), coordinate(random)};
  const std::vector<std::pair<const char*, obstacle::Shape>> shapes{
      {"half space", obstacle::HalfSpace{}},
      {"ball", obstacle::Ball{}},
      {"box", obstacle::Box{}},
      {"height field of a formula", obstacle::HeightField(std::make_shared<const geometry::SpaceFunction>(
                                        "0.1*cos(6*X)*cos(6*Y)", geometry::Constants{}))},
      {"199 396 triangles", obstacle::TriangleSurface(sphere(316))}};
  std::int64_t nodes = 0;
  const double one = factorisation(6, nodes);
  fmt::print("one factorisation, {} nodes: {:.2f} s\n", nodes, one);
  for (const auto& [name, shape] : shapes) {
    const obstacle::Obstacle body{.shape = shape};
    double sum = 0;
    const double seconds = time([&] {
      for (const Vector3d& X : points) sum += body.nearest(X, 0).distance;
    });
    fmt::print("{:<28} {:8.4f} s, {:6.4f} factorisations, mean distance {:.4f}\n", name, seconds, seconds / one,
               sum / static_cast<double>(points.size()));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv, 1);
  plastron::benchmarks::report();
}
