// The product through strains for packs of cells, one cell in each lane of the processor's vector registers. The file
// holds the input of the inner loops as plain arrays, and the loops as functions. The functions are compiled once for
// each set of instructions (pack_formulas.hpp) and chosen when the program runs. Sums are taken in the same order in
// every run; another set of instructions changes last digits only.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace plastron::energy {

/// A table of basis functions by rows, and its transpose.
struct PackTable {
  const double* values = nullptr;
  const double* transposed = nullptr;
  int rows = 0, columns = 0;  ///< points, nodes
};

/// Cells in packs of `lanes`: cell c is lane c % lanes of pack c / lanes. Unused lanes of the last pack contain copies
/// of the last cell. Arrays of geometry run by pack, point, quantity, lane and are aligned to 64 bytes.
struct PackedCells {
  enum class Kind {
    tied,    ///< squares whose membrane and shear strains are tied (M22)
    square,  ///< squares without tied strains
    plain    ///< cells without tensor product
  };
  /// Quantities of a quadrature point: a_1, a_2, e, then b_11, b_22, b_12 on charts. Computing the others is faster than
  /// reading them from memory. With directors the last ones are a_3, d_1 a_3, d_2 a_3.
  static constexpr int chart_point_size = 10, director_point_size = 16;
  int point_size() const { return has_directors ? director_point_size : chart_point_size; }
  /// Quantities of a sampling point: the two vectors for its strains.
  static constexpr int sampling_size = 6;
  /// Quantities of a cell's material: E nu / (1 - nu^2), mu, k_s mu, E. The first three are those of isotropic cells.
  static constexpr int material_size = 4;
  /// Quantities of a section: the rows of A, B, D up to the diagonal, then those of S.
  static constexpr int section_size = 21;

  Kind kind = Kind::tied;
  bool has_directors = false;
  std::size_t cells = 0;
  int nodes_per_cell = 0, points_per_cell = 0;
  const std::int32_t* nodes = nullptr;  ///< nodes of all cells
  const double* points = nullptr;
  const double* samplings = nullptr;  ///< points of the three sets of (M22), set by set: a_1, a_3; a_2, a_3; a_1, a_2
  const double* materials = nullptr;  ///< values by pack, quantity, lane
  const double* sections = nullptr;   ///< sections of the quadrature points; null if all cells are isotropic
  const double* weights = nullptr;    ///< weights of the quadrature points
  /// Tables along a line: values and derivatives at the full and reduced Gauss points, and the map from reduced to full
  /// points.
  PackTable value{}, d{}, reduced_value{}, reduced_d{}, from_reduced{};
  /// Tables of a cell without tensor product: values and derivatives at its points.
  PackTable cell_value{}, cell_d1{}, cell_d2{};

  std::size_t sampling_points() const {
    const auto k = static_cast<std::size_t>(reduced_value.rows);
    return kind == Kind::tied ? k * (3 * k + 2) : 0;
  }
};

struct PackEnergies {
  double membrane = 0, bending = 0, shear = 0;
};

/// Loops over all packs. Fields have six values for each node, scalars one.
struct PackKernels {
  const char* name;  ///< name of the instructions
  int lanes;         ///< cells in a pack
  /// Computes f += A y.
  void (*add_product)(const PackedCells& cells, const double* y, double* f);
  /// Returns 1/2 a(y, y) by its parts.
  PackEnergies (*energies)(const PackedCells& cells, const double* y);
  /// Adds factor times the form of normal_rotation.hpp on y to f.
  void (*add_normal_rotation)(const PackedCells& cells, double factor, const double* y, double* f);
  /// Computes q += b(y, N_i) and f += b(phi_j, lambda) of normal_rotation.hpp.
  void (*add_coupling)(const PackedCells& cells, const double* y, double* q);
  void (*add_coupling_transposed)(const PackedCells& cells, const double* lambda, double* f);
  /// Computes the lower triangle of k = b' b, b row by row. The rest of k is unchanged or filled.
  void (*gram)(const double* b, int rows, int columns, double* k);
};

/// Returns the kernels for this processor, the widest first. All builds have at least one.
std::span<const PackKernels* const> pack_kernels();

}  // namespace plastron::energy
