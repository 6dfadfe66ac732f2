// The geometry of all cells of a rank at quadrature and sampling points, in packs. The product through strains reads it
// in this order (pack_kernels.hpp). Quantities that follow from others are not stored.
#pragma once
#include <plastron/element/element_tables.hpp>
#include <plastron/energy/cross_sections.hpp>
#include <plastron/energy/pack_kernels.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/geometry/frame.hpp>

#include <array>
#include <vector>

namespace plastron::energy {

/// Geometry at a point that the membrane and shear strains need.
struct SamplingPoint {
  std::array<geometry::Vector3d, 2> a_cov{geometry::Vector3d::Zero(), geometry::Vector3d::Zero()};
  geometry::Vector3d a3 = geometry::Vector3d::Zero();
};

class CellPacks {
 public:
  /// Stores the geometry of the owned cells. Precondition: the surface is regular and the thickness positive at the
  /// quadrature points.
  CellPacks(const fem::Space& space, const fem::Surface& surface, const CrossSections& sections,
            const element::ElementTables& tables, const PackKernels& kernels);

  const PackKernels& kernels() const { return *kernels_; }
  /// Returns the arrays for the kernels. They point into this object and into `space`.
  PackedCells view(const fem::Space& space) const;

  geometry::Frame frame(std::size_t cell, std::size_t q) const;
  double thickness(std::size_t cell, std::size_t q) const { return point(cell, q)[6 * lanes()]; }
  /// Returns point t of the tables' sampling `set`. With tied strains, vectors that the strains of this set do not need
  /// are zero.
  SamplingPoint sampling_point(std::size_t set, std::size_t cell, std::size_t t) const;

 private:
  struct alignas(64) Line {
    double values[8];
  };
  struct Table {
    Table() = default;
    explicit Table(const Eigen::MatrixXd& table);
    PackTable view() const { return {values.data(), transposed.data(), rows, columns}; }
    std::vector<double> values, transposed;
    int rows = 0, columns = 0;
  };

  std::size_t lanes() const { return static_cast<std::size_t>(kernels_->lanes); }
  std::size_t point_size() const {
    return static_cast<std::size_t>(PackedCells{.has_directors = has_directors_}.point_size());
  }
  static double* data(std::vector<Line>& lines) { return lines.empty() ? nullptr : lines.front().values; }
  static const double* data(const std::vector<Line>& lines) { return lines.empty() ? nullptr : lines.front().values; }
  /// Returns the place of a cell's first quantity at `point`, in an array with `quantities` values for each of
  /// `points`. The next quantity is lanes() further.
  std::size_t place(std::size_t cell, std::size_t points, std::size_t point, std::size_t quantities) const {
    return ((cell / lanes() * points + point) * quantities) * lanes() + cell % lanes();
  }
  const double* point(std::size_t cell, std::size_t q) const {
    return data(points_) + place(cell, weights_.size(), q, point_size());
  }
  void set_tables(const element::ElementTables& tables);
  /// Writes the geometry of `cell` to the place of cell number `to`.
  void set_points(const fem::Surface& surface, const CrossSection& section, const fem::Cell& cell, std::size_t to);
  void set_sampling_points(const fem::Surface& surface, const fem::Cell& cell, std::size_t to);
  void set_material(const shell::Material& material, std::size_t to);
  /// Writes the sections of the points that set_points() has written.
  void set_sections(const shell::Material& material, std::size_t to);

  const PackKernels* kernels_;
  PackedCells::Kind kind_;
  bool has_directors_;
  std::vector<std::vector<fem::Vector2d>> sampling_xi_{};  ///< sampling points of tied strains
  std::vector<fem::Vector2d> xi_;
  std::vector<double> weights_;
  std::vector<Line> points_{}, samplings_{}, materials_{}, sections_{};
  Table value_{}, d_{}, reduced_value_{}, reduced_d_{}, from_reduced_{}, cell_value_{}, cell_d1_{}, cell_d2_{};
};

}  // namespace plastron::energy
