#include <plastron/meshing/imperfections.hpp>

#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/fem/shape_field.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <utility>

namespace plastron::meshing {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Vector3d;
using Vector6 = fem::ShapeField::Vector6;
using Shifts = std::vector<std::shared_ptr<const mesh::SurfaceShift>>;

/// Returns the place of a point of a patch and the director there.
geometry::Frame frame_in_patch(const mesh::SurfacePatches& patches, int patch, const Vector2d& xi) {
  return patches.frame(patch, {.value = xi, .d = {Vector2d::UnitX(), Vector2d::UnitY()}, .dd = {}});
}

/// Returns (u, r) at a place of the surface with the director a_3. The cofactors of 1 + grad u turn normals. A displacement w
/// along a_3 turns them by -grad w; the product of w and the curvature is neglected there, and a director need not be normal.
Vector6 shift_at(const problem::Imperfection& imperfection, const Vector3d& place, const Vector3d& a3) {
  Vector3d u = Vector3d::Zero(), turned = a3;
  if (imperfection.normal) {
    const geometry::SpaceJet w = (*imperfection.normal)(place);
    u = w.value * a3;
    turned -= geometry::tangential(w.gradient, a3);
  } else {
    Matrix3d gradient = Matrix3d::Identity();
    for (int k = 0; k < 3; ++k) {
      const geometry::SpaceJet component = (*imperfection.displacement[static_cast<std::size_t>(k)])(place);
      u[k] = component.value;
      gradient.row(k) += component.gradient;
    }
    turned = gradient.determinant() * gradient.inverse().transpose() * a3;
  }
  Vector6 shift;
  shift << u, turned.normalized() - a3;
  return shift;
}

using Field = std::shared_ptr<const fem::ShapeField>;

Vector6 shift_in_patch(const problem::Imperfection& imperfection, const mesh::SurfacePatches& patches, int patch,
                       const Vector2d& xi) {
  const geometry::Frame frame = frame_in_patch(patches, patch, xi);
  return shift_at(imperfection, frame.phi, frame.a3.normalized());
}

/// Compares the interpolated displacement with the expression between the nodes.
void check_interpolation(const problem::Imperfection& imperfection, const mesh::SurfacePatches& patches,
                         const fem::ShapeField& field, int degree) {
  constexpr double tolerance = 1e-2;
  double largest = 0, error = 0;
  Vector3d worst = Vector3d::Zero();
  const Vector2d centre = mesh::centre(patches.shape);
  for (int patch = 0; patch < static_cast<int>(patches.patches.size()); ++patch)
    for (const Vector2d& xi : mesh::lattice(patches.shape, degree + 1)) {
      const Vector3d exact = shift_in_patch(imperfection, patches, patch, xi).head<3>();
      const Vector3d found =
          field.at(mesh::address_of(patch, xi), mesh::address_of(patch, xi + 1e-6 * (centre - xi))).u;
      largest = std::max(largest, exact.norm());
      if (const double e = (found - exact).norm(); !(e <= error)) {
        error = e;
        worst = frame_in_patch(patches, patch, xi).phi;
      }
    }
  if (!(error <= tolerance * largest))
    throw mesh::DomainError(
        fmt::format("an imperfection varies too fast for the cells of the mesh: near ({:.4g}, {:.4g}, {:.4g}) its "
                    "interpolation is {:.2g} m off; mesh the part with smaller cells",
                    worst[0], worst[1], worst[2], error));
}

/// Interpolates an imperfection on every cell of a mesh in space.
Field interpolated(const problem::Imperfection& imperfection, const mesh::CoarseMesh& coarse) {
  constexpr int least_degree = 4, largest_degree = 8;
  if (imperfection.normal && !coarse.folds.empty())
    throw mesh::DomainError(
        "an imperfection along the normal would part the sides of a fold; give displacement = [three expressions], or "
        "the shape of a mode");
  const mesh::SurfacePatches& patches = *coarse.patches;
  int degree = least_degree;
  for (const mesh::SurfacePatches::Patch& patch : patches.patches) degree = std::max(degree, patch.order);
  fem::ShapeField::Cells cells{.shape = patches.shape, .degree = std::min(degree, largest_degree)};
  const int used = cells.degree;
  for (int patch = 0; patch < static_cast<int>(patches.patches.size()); ++patch)
    for (const Vector2d& xi : mesh::node_points(patches.shape, used)) {
      cells.points.push_back(mesh::address_of(patch, xi));
      cells.values.push_back(shift_in_patch(imperfection, patches, patch, xi));
    }
  auto field = std::make_shared<const fem::ShapeField>(std::move(cells));
  check_interpolation(imperfection, patches, *field, used);
  return field;
}

/// Checks on every rank that the mode belongs to the shell: its domain is as large, and its places are those of the shell.
void check_mode(const fem::ShapeField& mode, const problem::Problem& problem, const mesh::CoarseMesh& coarse) {
  constexpr double tolerance = 1e-2;  // of the extent
  const fem::Surface surface(std::make_shared<const mesh::CoarseMesh>(coarse), problem.charts);
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  assembly::BoundingBox places;
  double apart = 0;
  for (int c = 0; c < static_cast<int>(coarse.cells.size()); ++c)
    for (const Vector2d& xi : mesh::lattice(coarse.shape, 2)) {
      Vector2d x;
      surface.positions({.coarse = c}, {&xi, 1}, {&x[0], 1}, {&x[1], 1});
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
      const Vector3d phi = surface.frame({.coarse = c}, xi, false).phi;
      places.low = places.low.cwiseMin(phi);
      places.high = places.high.cwiseMax(phi);
      const Vector2d inside = xi + 1e-3 * (mesh::centre(coarse.shape) - xi);
      surface.positions({.coarse = c}, {&inside, 1}, {&x[0], 1}, {&x[1], 1});
      apart = std::max(apart, (mode.place_at(x) - surface.frame({.coarse = c}, inside, false).phi).norm());
    }
  const auto [mode_low, mode_high] = mode.box();
  const double off = std::max((low - mode_low).cwiseAbs().maxCoeff(), (high - mode_high).cwiseAbs().maxCoeff());
  if (!(off <= tolerance * (high - low).maxCoeff()))
    throw mesh::DomainError(
        fmt::format("a mode belongs to another domain: x from {:.6g} to {:.6g}, y from {:.6g} to {:.6g}; this one has "
                    "x from {:.6g} "
                    "to {:.6g}, y from {:.6g} to {:.6g}",
                    mode_low[0], mode_high[0], mode_low[1], mode_high[1], low[0], high[0], low[1], high[1]));
  if (!(apart <= tolerance * 2 * places.half_diagonal()))
    throw mesh::DomainError(
        fmt::format("a mode belongs to another mid-surface, which is up to {:.3g} m away from this one", apart));
}

}  // namespace

Shifts shifts_of(const problem::Problem& problem, const mesh::CoarseMesh& coarse) {
  Shifts shifts;
  for (const problem::Imperfection& imperfection : problem.imperfections) {
    if (imperfection.shift) {
      check_mode(*imperfection.shift, problem, coarse);
      shifts.push_back(imperfection.shift);
    } else if (coarse.patches) {
      shifts.push_back(interpolated(imperfection, coarse));
    }
  }
  return shifts;
}

}  // namespace plastron::meshing
