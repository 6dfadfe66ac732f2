#include <plastron/study/locking.hpp>

#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/study/extent.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::study {

namespace {

using Eigen::Vector3d;

/// A cell whose membrane and shear strains can only follow a bending to order h^k takes (h^k / (e L^{k-1}))^2 too much
/// energy for it. Largest h (e/L)^{-1/k} / L at which that costs a tenth of the deflection, measured for degree 1 to 3
/// (docs/methods/triangles.md); higher degrees were not seen to lock on meshes one would use.
constexpr std::array<double, 3> largest_size = {0.7, 1.3, 1.7};

struct CornerPoints {
  std::vector<Vector3d> phi;
  std::vector<double> thickness;
};

CornerPoints corner_points(const Problem& problem, const fem::Surface& surface, const fem::Cell& cell) {
  const fem::Shape shape = problem.discretisation.cells;
  std::vector<Eigen::Vector2d> xi(static_cast<std::size_t>(fem::corner_count(shape)));
  for (std::size_t k = 0; k < xi.size(); ++k) xi[k] = fem::corner(shape, static_cast<int>(k));
  std::vector<geometry::SurfaceJet> jets(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  CornerPoints corners{.phi = {}, .thickness = std::vector<double>(xi.size())};
  surface.jets(cell, xi, jets, false);
  surface.positions(cell, xi, x, y);
  problem.thickness.evaluate(x, y, corners.thickness);
  for (const geometry::SurfaceJet& jet : jets) corners.phi.push_back(jet.value);
  return corners;
}

double longest_side(fem::Shape shape, const CornerPoints& corners) {
  double longest = 0;
  for (int side = 0; side < fem::corner_count(shape); ++side) {
    const auto [from, to] = fem::side_corners(shape, side);
    longest = std::max(
        longest, (corners.phi[static_cast<std::size_t>(to)] - corners.phi[static_cast<std::size_t>(from)]).norm());
  }
  return longest;
}

/// Longest sides and smallest thicknesses [m] of the cells of the finest mesh, seen on a mesh of some hundred cells.
std::vector<std::pair<double, double>> sizes_of(const Problem& problem) {
  constexpr int enough_cells = 256;
  const Discretisation& d = problem.discretisation;
  fem::MeshSequence meshes(fem::coarse_mesh(problem.domain, d.cells), 1, MPI_COMM_SELF);
  int level = 0;
  for (; meshes.space()->global_cells < enough_cells; ++level) meshes.refine({});
  const fem::Surface surface(meshes.space()->coarse, problem.charts);
  const double to_finest = std::exp2(level - d.refinements);
  std::vector<std::pair<double, double>> sizes;
  for (const fem::Cell& cell : meshes.space()->cells) {
    const CornerPoints corners = corner_points(problem, surface, cell);
    sizes.emplace_back(to_finest * longest_side(d.cells, corners), *std::ranges::min_element(corners.thickness));
  }
  return sizes;
}

}  // namespace

std::vector<std::string> locking_warnings(const Problem& problem) {
  const Discretisation& d = problem.discretisation;
  const bool is_tied = d.tying && d.cells == fem::Shape::quadrilateral;
  if (is_tied || d.degree > static_cast<int>(largest_size.size())) return {};
  const double L = extent(problem);
  double worst = 0, size = 0, limit = 0, thickness = 0;
  for (const auto& [h, e] : sizes_of(problem)) {
    const double allowed = largest_size[static_cast<std::size_t>(d.degree - 1)] * L * std::pow(e / L, 1.0 / d.degree);
    if (h / allowed <= worst) continue;
    worst = h / allowed;
    size = h;
    limit = allowed;
    thickness = e;
  }
  if (worst <= 1) return {};
  const bool triangles = d.cells == fem::Shape::triangle;
  return {fmt::format(
      "{} of degree {} without tying are likely to lock: sides of the finest mesh are up to {:.3g} m long, {:.3g} "
      "times the "
      "thickness, and displacements in bending come out more than 10 % too small from about {:.2g} m on; {}, or "
      "refine {} more time{}",
      triangles ? "triangles" : "quadrilaterals", d.degree, size, size / thickness, limit,
      triangles ? (d.degree == 1 ? "take cells = \"quadrilateral\" with tying, or degree 2"
                                 : "take cells = \"quadrilateral\" with tying")
                : "set tying = true",
      std::ceil(std::log2(worst)), worst > 2 ? "s" : "")};
}

}  // namespace plastron::study
