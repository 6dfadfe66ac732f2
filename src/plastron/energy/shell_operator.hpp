// The discrete shell on one mesh: strains of a nodal field, and the bilinear form a(., .) of (M8) as an operator.
// The operator works through strains (B u first, then C, then B'), so that rounding acts on strains and not on
// displacements (D6). Products and energies of the whole shell use cells in packs (cell_packs.hpp). Functions of a
// single cell are the plain form of the same formulas.
#pragma once
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/element/interpolation.hpp>
#include <plastron/energy/cell_packs.hpp>
#include <plastron/energy/cross_sections.hpp>
#include <plastron/energy/factors.hpp>
#include <plastron/shell/section.hpp>

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace plastron::energy {

using Eigen::MatrixXd;
using Eigen::Vector2d;

/// Strains or weighted stresses of a cell, one row for each point: gamma_11 gamma_22 2gamma_12, the same of chi,
/// 2delta_1 2delta_2.
using CellStrain = Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Energies {
  double membrane = 0, bending = 0, shear = 0;  ///< [J]
  double foundations = 0;                       ///< of what carries the shell elastically, and of hinges [J]
  double total() const { return membrane + bending + shear + foundations; }
};

/// Geometry and stiffness at a quadrature point, in the element's own coordinates.
struct QuadraturePoint {
  geometry::Frame frame;
  shell::Section section;  ///< without weight
  double thickness;        ///< e of the cell's own region [m]
  double young;            ///< E of the cell's own region [Pa]
  double area;             ///< sqrt(a) times the quadrature weight [m^2]
};

/// The vectors by which strains depend on a cell's surface: tangents, director and its derivatives at the quadrature
/// points and at the points of each sampling. They are those of the reference or of a deformed state (M23); metric and
/// area are always those of the reference.
struct CellGeometry {
  std::vector<geometry::Frame> frames{};
  std::vector<std::vector<SamplingPoint>> samplings{};
};

class ShellOperator {
 public:
  /// Membrane and shear components at sampling points, one row for each: 11 22 2x12, 2delta_1 2delta_2.
  using SampledStrain = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;

  /// Precondition: the surface is regular and the thickness positive at the quadrature points. Covariant interpolation
  /// follows (M15). Throws mesh::DomainError for cross-sections of regions that the mesh does not have.
  ShellOperator(std::shared_ptr<const fem::Space> space, std::shared_ptr<const fem::Surface> surface,
                CrossSections sections, bool tying, bool is_covariant,
                const PackKernels& kernels = *pack_kernels().front());

  /// Lets geometry() take a_a, a_3 and d_a a_3 from the interpolation of (phi, a_3) at the nodes, block 6, in the place of the
  /// exact surface: a rigid rotation of any size then has no strain (M24-M26). Metric and area stay exact.
  void interpolate_reference(algebra::Vector places_and_directors) { reference_ = std::move(places_and_directors); }

  const fem::Space& space() const { return *space_; }
  const std::shared_ptr<const fem::Space>& space_pointer() const { return space_; }
  const fem::Surface& surface() const { return *surface_; }
  const element::ElementTables& tables() const { return tables_; }
  const CrossSections& sections() const { return sections_; }
  /// Returns the cross-section of the cell's region.
  const CrossSection& section(std::size_t cell) const { return sections_.at(*space_->coarse, space_->cells[cell]); }
  const element::Interpolation& interpolation() const { return interpolation_; }
  /// Moving bases at the quadrature points of a cell; empty for Cartesian interpolation.
  element::Interpolation::Bases quadrature_bases(std::size_t cell) const {
    return bases_at(quadrature_bases_, cell, tables_.weights.size());
  }

  element::CellField gather(std::size_t cell, const algebra::Vector& y) const;
  /// Adds a cell's nodal forces to f's local values.
  void scatter(std::size_t cell, const element::CellField& forces, algebra::Vector& f) const;
  CellGeometry geometry(std::size_t cell) const;
  /// Returns the geometry that `moved` has deformed.
  CellGeometry geometry(std::size_t cell, const element::CellField& moved) const;
  /// Strains at the quadrature points, tied where tying is on (M4-M6, M22). With the geometry of a state they are the
  /// derivative of finite_strains() along `field`.
  CellStrain strains(std::size_t cell, const element::CellField& field, const CellGeometry& at) const;
  CellStrain strains(std::size_t cell, const element::CellField& field) const {
    return strains(cell, field, geometry(cell));
  }
  /// Strains of finite rotations (M24-M26), tied alike. They are polynomials of second degree: the map of the state half
  /// way, applied to the field.
  CellStrain finite_strains(std::size_t cell, const element::CellField& field) const {
    return strains(cell, field, geometry(cell, field / 2));
  }
  /// Nodal forces of weighted stresses: the transpose of strains().
  element::CellField forces(std::size_t cell, const CellStrain& stresses, const CellGeometry& at) const;
  element::CellField forces(std::size_t cell, const CellStrain& stresses) const {
    return forces(cell, stresses, geometry(cell));
  }
  /// Returns weighted membrane and shear stresses at the points of a sampling: the transpose of the interpolation.
  SampledStrain sampled_stresses(std::size_t sampling, const CellStrain& stresses) const;
  /// Stresses times area at the quadrature points: N, M, Q of (M8), without the share of initial strains.
  CellStrain weighted_stresses(std::size_t cell, const CellStrain& strains) const;
  /// Returns N_0, M_0 of initial strains times area at the quadrature points; empty if the cell has none.
  std::optional<CellStrain> weighted_initial_stresses(std::size_t cell, const Factors& factors) const;
  /// Returns what strains the cell without stress at points.
  std::vector<shell::InitialState> initial_states(std::size_t cell, const std::vector<Vector2d>& xi,
                                                  const Factors& factors) const;
  /// Returns eps_0, the strains of N_0 and M_0, which are free of stress resultants; empty if the cell has none.
  std::optional<CellStrain> initial_strains(std::size_t cell, const Factors& factors) const;
  /// Returns the matrix of strains(): rows by point in the order of CellStrain, columns by node in the order of
  /// CellField.
  RowMatrix strain_matrix(std::size_t cell, const CellGeometry& at) const;
  RowMatrix strain_matrix(std::size_t cell) const { return strain_matrix(cell, geometry(cell)); }

  /// Strains at other points of a cell: tied components through `tied` (tied_interpolation at those points), the others
  /// directly. `state`: (u, r) at which the strains are linearised, as in geometry(); null for the reference.
  CellStrain strains_at(std::size_t cell, const element::CellField& field, const element::BasisAt& basis,
                        const std::vector<MatrixXd>& tied, std::span<const geometry::Frame> frames,
                        const element::CellField* state = nullptr) const;

  /// Computes f = A y for Cartesian nodal values (block 6). Needs y's ghosts; f is complete on owned nodes
  /// (collective).
  void apply(const algebra::Vector& y, algebra::Vector& f) const;
  /// Adds the product A y of this rank's cells to f's local values. f.accumulate_ghosts() then completes the sum.
  void add_product(const algebra::Vector& y, algebra::Vector& f) const;
  /// Returns 1/2 a(y, y) by its three parts, over all ranks (collective).
  Energies energies(const algebra::Vector& y) const;
  /// Returns the three parts of 1/2 S : C : S of strains S at the quadrature points of owned cells, over all ranks
  /// (collective).
  Energies energies_of(const std::function<CellStrain(std::size_t cell)>& strains_at) const;

  geometry::Frame frame_at(std::size_t cell, int q) const { return packs_.frame(cell, static_cast<std::size_t>(q)); }
  /// Computes a quadrature point from stored data.
  QuadraturePoint point(std::size_t cell, int q) const;
  /// Area of a cell: int sqrt(a) dx [m^2].
  double area(std::size_t cell) const;

  /// Returns the owned cells for the loops over packs. Not for covariant interpolation, whose strains these loops do
  /// not compute.
  PackedCells packed() const {
    PLASTRON_ASSERT(has_packed_strains());
    return packs_.view(*space_);
  }
  const PackKernels& kernels() const { return packs_.kernels(); }
  bool has_packed_strains() const { return !interpolation_.is_covariant(); }

 private:
  /// Asserts six values for every node that this rank sees.
  void assert_is_field(const algebra::Vector& y, const char* what) const;
  static element::Interpolation::Bases bases_at(const std::vector<geometry::MovingBasis>& all, std::size_t cell,
                                                std::size_t count) {
    return all.empty() ? element::Interpolation::Bases{}
                       : element::Interpolation::Bases(all.data() + cell * count, count);
  }
  element::Interpolation::Bases sampling_bases(std::size_t sampling, std::size_t cell) const {
    return bases_at(sampling_bases_[sampling], cell, tables_.samplings[sampling].basis.xi.size());
  }
  SampledStrain sampled_strains(std::size_t sampling, std::size_t cell, const element::CellField& field,
                                const CellGeometry& at) const;

  /// Returns T_m and dT of a temperature at points of a cell.
  Eigen::MatrixX2d values_of(const Temperature& temperature, std::size_t cell, const std::vector<Vector2d>& xi) const;

  /// Calls change(point, field there) for all points of the geometry.
  template <class Change>
  void change_points(std::size_t cell, const element::CellField& field, CellGeometry& at, const Change& change) const;

  std::shared_ptr<const fem::Space> space_;
  std::shared_ptr<const fem::Surface> surface_;
  CrossSections sections_;
  element::ElementTables tables_;
  element::Interpolation interpolation_;
  CellPacks packs_;
  /// T_m and dT of the temperatures of each owned cell at its quadrature points; empty where nothing is heated.
  std::vector<std::vector<Eigen::MatrixX2d>> temperatures_{};
  std::vector<geometry::MovingBasis> quadrature_bases_;  // owned cells x quadrature points; empty if Cartesian
  std::vector<std::vector<geometry::MovingBasis>> sampling_bases_;  // per sampling: owned cells x its points
  algebra::Vector reference_{};  // see interpolate_reference(); without layout: the exact surface
};

}  // namespace plastron::energy
