// Looks for jumps inside of the cells of the finest mesh: where samples are not on a line, the segment between them is
// divided again and again; what is continuous shrinks with it, a jump stays. Poles grow, yet not all of them are met.
#pragma once
#include <plastron/examination/checks.hpp>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace plastron::examination {

/// Up to nine values at a point.
using Sample = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
/// A function of points of a cell, reference coordinates. The values are compared with 1.
using CellFunction = std::function<Sample(const fem::Cell& cell, const Eigen::Vector2d& xi)>;

struct Jump {
  Eigen::Vector2d at;      ///< in Omega
  double size = 0;         ///< as a multiple of what the function was scaled by
  bool is_bounded = true;  ///< or the function grows without limit there
};

class JumpSearch {
 public:
  explicit JumpSearch(const Examined& examined);

  /// Jumps on lines of the finest mesh may be allowed, or at the corners of its cells only.
  enum class Lines { forbidden, allowed, at_corners };

  /// The first jump larger than the tolerance. Values that are not finite are an unbounded jump.
  std::optional<Jump> in_cells(const CellFunction& f, double tolerance, Lines on_lines) const;
  /// Likewise, with many samples on a few lines through each cell: sees slits much narrower than cells, which in_cells() may step over.
  std::optional<Jump> along_lines(const CellFunction& f, double tolerance, Lines on_lines) const;
  /// As in_cells(); corners of cells of the finest mesh are allowed.
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
  std::shared_ptr<const fem::Space> space_;  ///< the finest mesh, or one before it that has cells enough
  double finest_;                            ///< cells of the finest mesh along a side of a coarse cell
  std::vector<Eigen::Vector2d> points_;      ///< of every cell
  std::vector<std::pair<std::size_t, std::size_t>> segments_;  ///< between these points
};

}  // namespace plastron::examination
