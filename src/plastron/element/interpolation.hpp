// Interpolation of u and r inside a cell from nodal values. The formulations differ only here:
//   Cartesian (M12-M14)   u = sum_i N_i u_i,  r = sum_i N_i r_i
//   covariant (M15)       u = sum_i N_i (u_i . a_j(i)) a^j,  r = sum_i N_i (r_i . a_alpha(i)) a^alpha
// Nodal values are Cartesian in both cases. Supports, contact, loads and output therefore do not depend on the
// formulation.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/shell/strain.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::element {

/// Nodal values of a cell: a row per node, columns u_x u_y u_z r_x r_y r_z.
using CellField = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// (u, r) and their derivatives along the cell's coordinates at points: a row per point, Cartesian components. A dual
/// contains the work-conjugate of each.
struct FieldRows {
  CellField d1, d2, value;

  shell::LocalField<double> at(Eigen::Index point) const;
  static FieldRows zero(Eigen::Index points);
  void add_dual(Eigen::Index point, const shell::LocalField<double>& dual);
};

class Interpolation {
 public:
  using Bases = std::span<const geometry::MovingBasis>;

  Interpolation(std::shared_ptr<const fem::Space> space, std::shared_ptr<const fem::Surface> surface,
                const ElementTables& tables, bool is_covariant);

  bool is_covariant() const { return is_covariant_; }
  /// The moving bases at points of a cell; empty for Cartesian interpolation.
  std::vector<geometry::MovingBasis> bases(std::size_t cell, std::span<const Vector2d> xi) const;

  /// Returns the fields at the points of `at`, whose moving bases are `bases`.
  FieldRows fields(std::size_t cell, const BasisAt& at, Bases bases, const CellField& nodal) const;
  /// The transpose of fields(): adds nodal forces.
  void add_forces(std::size_t cell, const BasisAt& at, Bases bases, FieldRows dual, CellField& forces) const;
  /// Writes one row of the matrix that maps nodal values (6 per node) to dual : field at a point.
  void write_row(std::size_t cell, const BasisAt& at, Eigen::Index point, Bases bases,
                 const shell::LocalField<double>& dual, Eigen::Ref<Eigen::RowVectorXd> row) const;

  /// Returns the interpolated nodal values: (u, r) itself or its covariant components. These fields are polynomials
  /// in each cell, so refinement represents them exactly. The results have valid ghosts.
  algebra::Vector interpolated(const algebra::Vector& y) const;
  /// The inverse of interpolated(), except for the normal part of r, which covariant interpolation does not have.
  algebra::Vector nodal_values(const algebra::Vector& interpolated) const;

  /// Returns only (u, r), without derivatives.
  CellField values(std::size_t cell, const BasisAt& at, const CellField& nodal) const;
  /// The transpose of values(): nodal forces from forces and couples at points.
  CellField forces_of(std::size_t cell, const BasisAt& at, const CellField& forces) const;

 private:
  CellField components(std::size_t cell, const CellField& nodal) const;
  void to_nodal_forces(std::size_t cell, CellField& of_components) const;

  std::shared_ptr<const fem::Space> space_;
  std::shared_ptr<const fem::Surface> surface_;
  bool is_covariant_;
  std::vector<geometry::Matrix3d> node_bases_;  // [a_1 a_2 a_3] at the nodes of owned cells; empty if Cartesian
};

}  // namespace plastron::element
