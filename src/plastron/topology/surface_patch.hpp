// The polynomial patch of a cell in space, phi(xi) = sum of L_n(xi) x_n over the nodes x_n of its lattice, and its
// normals a_1 x a_2.
#pragma once
#include <plastron/mesh/basis.hpp>
#include <plastron/topology/space_mesh.hpp>

#include <Eigen/Core>
#include <map>
#include <vector>

namespace plastron::topology {

/// Points and values of a cell at the points of a table, a row per point.
struct PatchPoints {
  Eigen::MatrixX3d phi, a1, a2;
  Vector3d normal(Eigen::Index point) const { return Vector3d(a1.row(point)).cross(Vector3d(a2.row(point))); }
};
PatchPoints patch_points(const mesh::LatticeTable& table, const SpaceMesh& mesh, const SurfaceCell& cell);

/// A cell is degenerate where |a_1 x a_2| does not exceed this value: 1e-9 of the product of the largest |a_1| and
/// |a_2|.
double degenerate_normal(const PatchPoints& points);

/// Tables by the order of the cells, made when they are first used. `points` returns the points for an order.
template <class Points>
class PatchTables {
 public:
  PatchTables(mesh::Shape shape, Points points) : shape_(shape), points_(std::move(points)) {}
  const mesh::LatticeTable& operator()(int order) {
    const auto [found, is_new] = tables_.try_emplace(order);
    if (is_new) found->second = mesh::lattice_table(shape_, order, points_(order));
    return found->second;
  }

 private:
  mesh::Shape shape_;
  Points points_;
  std::map<int, mesh::LatticeTable> tables_;
};

/// Integrals over a cell.
struct PatchIntegrals {
  double area = 0;                          ///< of |a_1 x a_2|, by quadrature [m^2]
  Vector3d area_vector = Vector3d::Zero();  ///< of a_1 x a_2, exact [m^2]
  double volume = 0;                        ///< of (phi - origin) . (a_1 x a_2) / 3, exact [m^3]
};
std::vector<PatchIntegrals> patch_integrals(const SpaceMesh& mesh, const Vector3d& origin);

}  // namespace plastron::topology
