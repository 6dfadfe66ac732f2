// Pieces of a cell: searches divide those that may hold what they look for.
#pragma once
#include <plastron/fem/surface.hpp>

#include <vector>

namespace plastron::certificate {

using fem::Vector2d;

/// A piece of a cell: the points whose coordinates differ from the centre's by at most `half`.
struct Piece {
  Vector2d centre;
  double half;

  /// Adds the four parts of the piece; on triangles those that have points of the cell.
  void divide(mesh::Shape shape, std::vector<Piece>& parts) const {
    for (const double i : {-0.5, 0.5})
      for (const double j : {-0.5, 0.5}) {
        const Vector2d middle = centre + half * Vector2d(i, j);
        if (shape == mesh::Shape::quadrilateral || middle.sum() - half < 1) parts.push_back({middle, half / 2});
      }
  }
  /// A point of the cell in the piece, and the largest difference of coordinates from it.
  Piece inside(mesh::Shape shape) const {
    if (shape == mesh::Shape::quadrilateral || centre.sum() <= 1) return *this;
    const Vector2d moved = (centre.array() - (centre.sum() - 1) / 2).max(0);
    return {moved, half + (moved - centre).cwiseAbs().maxCoeff()};
  }
};

}  // namespace plastron::certificate
