#include <plastron/meshing/imperfections.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/fem/shape_field.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <Eigen/LU>

#include <algorithm>

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

/// Interpolates an imperfection on every cell of a mesh in space.
std::shared_ptr<const mesh::SurfaceShift> interpolated(const problem::Imperfection& imperfection,
                                                       const mesh::CoarseMesh& coarse) {
  constexpr int least_degree = 4;
  const mesh::SurfacePatches& patches = *coarse.patches;
  int degree = least_degree;
  for (const mesh::SurfacePatches::Patch& patch : patches.patches) degree = std::max(degree, patch.order);
  fem::ShapeField::Cells cells{.shape = patches.shape, .degree = std::min(degree, 8)};
  const std::vector<Vector2d> nodes = mesh::node_points(patches.shape, cells.degree);
  for (std::size_t patch = 0; patch < patches.patches.size(); ++patch)
    for (const Vector2d& xi : nodes) {
      const geometry::Frame frame = frame_in_patch(patches, static_cast<int>(patch), xi);
      cells.points.push_back(mesh::address_of(static_cast<int>(patch), xi));
      cells.values.push_back(shift_at(imperfection, frame.phi, frame.a3.normalized()));
    }
  return std::make_shared<const fem::ShapeField>(std::move(cells));
}

/// Tries each cell of the mesh, so that all ranks find a mode of another domain together.
void check_domain(const mesh::SurfaceShift& shift, const mesh::CoarseMesh& coarse) {
  for (const mesh::CoarseCell& cell : coarse.cells) {
    const auto address = [&](const Vector2d& xi) {
      const Vector2d x = cell.map(xi).value;
      return coarse.patches ? mesh::address_of(cell.patch, x) : x;
    };
    const Vector2d centre = address(mesh::centre(coarse.shape));
    for (int k = 0; k < mesh::corner_count(coarse.shape); ++k) {
      constexpr double step = 1e-3;
      const Vector2d corner = address(mesh::corner(coarse.shape, k));
      static_cast<void>(shift.at(corner, corner + step * (centre - corner)));
    }
  }
}

}  // namespace

Shifts shifts_of(const std::vector<problem::Imperfection>& imperfections, const mesh::CoarseMesh& coarse) {
  Shifts shifts;
  for (const problem::Imperfection& imperfection : imperfections) {
    if (!imperfection.shift) {
      if (!coarse.patches) continue;
      shifts.push_back(interpolated(imperfection, coarse));
      continue;
    }
    check_domain(*imperfection.shift, coarse);
    shifts.push_back(imperfection.shift);
  }
  return shifts;
}

}  // namespace plastron::meshing
