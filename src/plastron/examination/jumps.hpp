// Searches for jumps inside the cells of the finest mesh. Where samples are not on a line, the segment between them is
// divided repeatedly. A continuous function shrinks with the segment, a jump stays. Poles grow, but not all of them are
// found.
#pragma once
#include <plastron/examination/checks.hpp>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace plastron::examination {

/// Up to nine values at a point.
using Sample = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
/// A function of points of a cell in reference coordinates. Its values are compared with 1.
using CellFunction = std::function<Sample(const fem::Cell& cell, const Eigen::Vector2d& xi)>;

struct Jump {
  Eigen::Vector2d at;      ///< in Omega
  double size = 0;         ///< relative to the scale of the function
  bool is_bounded = true;  ///< false: the function grows without limit there
};

class JumpSearch {
 public:
  explicit JumpSearch(const Examined& examined);

  /// Jumps that are allowed: none, on lines of the finest mesh, or only at the corners of its cells.
  enum class Lines { forbidden, allowed, at_corners };

  /// Returns the first jump larger than the tolerance. Values that are not finite are an unbounded jump.
  std::optional<Jump> in_cells(const CellFunction& f, double tolerance, Lines on_lines) const;
  /// Searches with many samples on a few lines through each cell. It finds slits much narrower than cells, which
  /// in_cells() may miss.
  std::optional<Jump> along_lines(const CellFunction& f, double tolerance, Lines on_lines) const;
  /// Searches a boundary like in_cells(); jumps at corners of cells of the finest mesh are allowed.
  std::optional<Jump> along_boundary(const std::string& name, const CellFunction& f, double tolerance) const;

 private:
  struct End {
    Eigen::Vector2d xi;
    Sample value;
  };
  std::optional<Jump> between(const fem::Cell& cell, const End& from, const End& to, const CellFunction& f,
                              double tolerance, Lines on_lines) const;
  bool is_allowed(const fem::Cell& cell, const Eigen::Vector2d& xi, Lines on_lines) const;
  Eigen::Vector2d position(const fem::Cell& cell, const Eigen::Vector2d& xi) const;

  const fem::Surface& surface_;
  std::shared_ptr<const fem::Space> space_;  ///< the finest mesh, or an earlier one with enough cells
  double finest_;                            ///< number of cells of the finest mesh along a side of a coarse cell
  std::vector<Eigen::Vector2d> points_;      ///< sample points of every cell
  std::vector<std::pair<std::size_t, std::size_t>> segments_;  ///< between these points
};

}  // namespace plastron::examination
