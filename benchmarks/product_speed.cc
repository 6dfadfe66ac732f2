// Measures the product through strains by degree, tying, size and instructions: product_speed [UNKNOWNS...]. It is compared with the product
// cell by cell, of which it is the packed form, and with copying the bytes that it reads and writes. Times are those of the calling thread,
// the best of several.
#include <plastron/algebra/session.hpp>
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>

namespace plastron::benchmarks {
namespace {

/// CPU seconds of one call, the least of several.
double seconds(const std::function<void()>& call) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  call();
  double best = INFINITY, spent = 0;
  for (int i = 0; i < 3 || (spent < 0.15 && i < 50); ++i) {
    const double start = now();
    call();
    const double once = now() - start;
    best = std::min(best, once);
    spent += once;
  }
  return best;
}

geometry::Chart chart() { return {{"x", "y", "x*x - 0.3*x*y"}, {}}; }

/// The same surface as a mesh in space with cells of order 2.
mesh::CoarseMesh in_space(mesh::CoarseMesh mesh) {
  auto patches = std::make_shared<mesh::SurfacePatches>();
  const geometry::Chart phi = chart();
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    mesh::SurfacePatches::Patch patch{.order = 2};
    for (const Eigen::Vector2d& xi : mesh::lattice(mesh::Shape::quadrilateral, 2)) {
      const Eigen::Vector2d x = mesh.cells[c].map(xi).value;
      const geometry::SurfaceJet jet = phi(x[0], x[1]);
      patch.nodes.push_back(static_cast<std::int32_t>(patches->positions.size()));
      patches->positions.push_back(jet.value);
      patches->directors.push_back(geometry::unit_normal(jet));
    }
    patches->patches.push_back(std::move(patch));
    mesh.cells[c].patch = static_cast<int>(c);
    mesh.cells[c].map = {mesh::LagrangeMap{1, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}}};
  }
  mesh.patches = std::move(patches);
  return mesh;
}

/// A square of about so many unknowns, five a node.
std::shared_ptr<const fem::Space> mesh_of(int degree, double unknowns, bool is_in_space) {
  const double cells = std::sqrt(unknowns / 5) / degree;
  int coarse = std::max(1, static_cast<int>(std::lround(cells))), refinements = 0;
  for (; coarse > 16; ++refinements) coarse = (coarse + 1) / 2;
  domain::Rectangle square;
  square.cells = {coarse, coarse};
  mesh::CoarseMesh mesh = domain::coarse_mesh(square, mesh::Shape::quadrilateral);
  if (is_in_space) mesh = in_space(std::move(mesh));
  fem::MeshSequence meshes(std::move(mesh), degree, MPI_COMM_WORLD);
  for (int i = 0; i < refinements; ++i) meshes.refine({});
  return meshes.space();
}

void apply_cell_by_cell(const energy::ShellOperator& shell, const algebra::Vector& y, algebra::Vector& f) {
  f.fill(0);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c)
    shell.scatter(c, shell.forces(c, shell.weighted_stresses(c, shell.strains(c, shell.gather(c, y)))), f);
}

/// Bytes that a product reads and writes.
double bytes_of(const energy::PackedCells& packed, std::size_t values) {
  const double of_geometry = 8.0 * (packed.points_per_cell * packed.point_size() +
                                    static_cast<double>(packed.sampling_points()) * energy::PackedCells::sampling_size +
                                    energy::PackedCells::material_size);
  return static_cast<double>(packed.cells) * (of_geometry + 4 * packed.nodes_per_cell) +
         8.0 * 3 * static_cast<double>(values);  // y read, f read and written
}

double copy_seconds(double bytes) {
  const auto size = static_cast<std::size_t>(bytes / 2);  // one half is read, the other written
  std::vector<char> from(size, 1), to(size);
  return seconds([&] { std::memcpy(to.data(), from.data(), size); });
}

void report(int degree, bool tying, double wanted, bool is_in_space) {
  const auto space = mesh_of(degree, wanted, is_in_space);
  std::map<std::string, geometry::Chart> charts;
  if (!is_in_space) charts.emplace("", chart());
  const auto surface = std::make_shared<const fem::Surface>(space->coarse, charts);
  const energy::CrossSections sections{
      .common = {.thickness = geometry::Expression(0.01), .material = shell::Material::from_young_poisson(1, 0.3, 1)}};
  algebra::Vector y(space->layout, 6), f = y;
  for (std::size_t i = 0; i < y.local().size(); ++i) y.local()[i] = std::sin(static_cast<double>(i));
  const double unknowns = 5.0 * static_cast<double>(space->layout->owned);
  fmt::print("{:>7} {:>6} {:>6} {:>9.0f}", is_in_space ? "mesh" : "chart", degree, tying, unknowns);
  double bytes = 0, plain = 0;
  for (const energy::PackKernels* kernels : energy::pack_kernels()) {
    const energy::ShellOperator shell(space, surface, sections, tying, false, *kernels);
    if (bytes == 0) {
      bytes = bytes_of(shell.packed(), y.local().size());
      plain = seconds([&] { apply_cell_by_cell(shell, y, f); });
    }
    fmt::print(" {:>8.1f}", unknowns / seconds([&] { shell.apply(y, f); }) / 1e6);
  }
  fmt::print(" {:>8.2f} {:>8.1f} {:>8.0f}\n", unknowns / plain / 1e6, unknowns / copy_seconds(bytes) / 1e6,
             bytes / unknowns);
  std::fflush(stdout);
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv, 1);
  std::vector<double> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atof(argv[i]));
  if (sizes.empty()) sizes = {25000, 100000, 400000};
  fmt::print("million unknowns a second\n{:>7} {:>6} {:>6} {:>9}", "surface", "degree", "tied", "unknowns");
  for (const auto* kernels : plastron::energy::pack_kernels()) fmt::print(" {:>8}", kernels->name);
  fmt::print(" {:>8} {:>8} {:>8}\n", "by cells", "copying", "B/unkn");
  for (const double size : sizes)
    for (const bool tying : {true, false})
      for (int degree = 2; degree <= 8; ++degree)
        for (const bool is_in_space : {false, true}) plastron::benchmarks::report(degree, tying, size, is_in_space);
}
