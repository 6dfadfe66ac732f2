#include <plastron/computation/locking.hpp>

#include <plastron/meshing/cell_sizes.hpp>
#include <plastron/meshing/extent.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::computation {

namespace {

/// Limit of the size h (e/L)^{-1/k} / L, at which locking costs a tenth of the deflection, measured for degree 1 to 3
/// (docs/methods/triangles.md). The reason: the membrane and shear strains of a cell can only follow a bending to order
/// h^k. The cell's energy is too large by (h^k / (e L^{k-1}))^2. Higher degrees did not lock on meshes of practical
/// size.
constexpr std::array<double, 3> largest_size = {0.7, 1.3, 1.7};

}  // namespace

std::vector<std::string> locking_warnings(const problem::Problem& problem) {
  const problem::Discretisation& d = problem.discretisation;
  const bool is_tied = problem.shell.tying && d.cells == fem::Shape::quadrilateral;
  if (is_tied || d.degree > static_cast<int>(largest_size.size())) return {};
  const double L = meshing::extent(problem);
  double worst = 0, size = 0, limit = 0, thickness = 0;
  for (const auto& [h, e] : meshing::cell_sizes(problem)) {
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

}  // namespace plastron::computation
