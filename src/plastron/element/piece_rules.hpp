// Quadrature of functions that jump or bend along curves: the points lie between the curves.
// In the direction t of a cell, every line s = const is cut where a curve crosses it, to the last digits.
// In the direction s, the cell is cut where a curve begins, ends, turns or has a corner. Interval arithmetic
// (geometry::Pieces) shows that nothing lies between. Between two cuts in s the integral over t is smooth except for
// roots at the ends. The substitution s = 3 u^2 - 2 u^3 removes these roots. Source: Saye, SIAM J. Sci. Comput. 37
// (2015), dimension by dimension as here.
#pragma once
#include <plastron/geometry/pieces.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace plastron::element {

using Eigen::Vector2d;

/// Returns the places of points of a cell, with X, Y, Z where a function needs them.
using Places = std::function<std::vector<geometry::Place>(std::span<const Vector2d> xi)>;

/// Functions of the place that are integrated together.
using PiecesOfAll = std::vector<const geometry::Pieces*>;

struct PieceRule {
  std::vector<Vector2d> xi;     ///< points in the reference cell
  std::vector<double> weights;  ///< in the reference cell, their sum is its area; on a side their sum is 1
};

/// Whether the functions are one piece on the whole cell.
bool are_one_piece(const PiecesOfAll& functions, mesh::Shape shape, const Places& places);

/// Returns a rule between the borders of pieces; nothing where a cell has more borders than a rule can follow.
std::optional<PieceRule> rule_between_borders(const PiecesOfAll& functions, mesh::Shape shape, int degree,
                                              const Places& places);

/// Returns a rule for a cell with too many borders. Each part of the cell that no border crosses has the cell's rule.
/// The remaining parts have it too when there are `most_parts`.
PieceRule rule_of_parts(const PiecesOfAll& functions, mesh::Shape shape, const PieceRule& of_cell, const Places& places,
                        std::size_t most_parts);

/// Returns the rule of rule_between_borders for a side of a cell, from its start to its end.
std::optional<PieceRule> rule_between_borders(const PiecesOfAll& functions, mesh::Shape shape, int side, int degree,
                                              const Places& places);

}  // namespace plastron::element
