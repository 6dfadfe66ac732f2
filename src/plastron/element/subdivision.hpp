// Integrals of functions with jumps or kinks inside a cell: the cell, or its side, is divided until the integral
// converges. Undivided Gauss rules converge there only like the mesh size, and a cell's share may be wrong by a
// third.
#pragma once
#include <plastron/element/interpolation.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace plastron::element {

/// Part of a reference cell: corner + size xi, xi in the reference cell. The size is negative for a triangle turned
/// by 180 degrees.
struct CellPart {
  Vector2d corner = Vector2d::Zero();
  double size = 1;
};

/// Part of a side: the parameters from `start` to `start` + `length`.
struct SidePart {
  double start = 0, length = 1;
};

inline std::array<CellPart, 4> divided(mesh::Shape shape, const CellPart& p) {
  const double h = p.size / 2;
  const Vector2d along_1(h, 0), along_2(0, h);
  if (shape == mesh::Shape::triangle)
    return {{{p.corner, h}, {p.corner + along_1, h}, {p.corner + along_2, h}, {p.corner + along_1 + along_2, -h}}};
  return {{{p.corner, h}, {p.corner + along_1, h}, {p.corner + along_2, h}, {p.corner + along_1 + along_2, h}}};
}
inline std::array<SidePart, 2> divided(mesh::Shape /*shape*/, const SidePart& p) {
  return {{{p.start, p.length / 2}, {p.start + p.length / 2, p.length / 2}}};
}

/// Divides until no nodal force or couple changes by more than 1e-6 of the largest one, at most `levels` times.
template <class Part, class Integral>
class Subdivision {
 public:
  Subdivision(mesh::Shape shape, const Integral& integral) : shape_(shape), integral_(integral) {}

  CellField operator()(int levels) {
    const CellField whole = integral_(Part{});
    note(whole);
    return settled(Part{}, whole, levels);
  }

 private:
  CellField settled(const Part& part, const CellField& whole, int levels) {
    std::vector<CellField> fields;
    const auto parts = divided(shape_, part);
    CellField sum = CellField::Zero(whole.rows(), 6);
    for (const Part& p : parts) sum += fields.emplace_back(integral_(p));
    note(sum);
    const CellField change = sum - whole;
    const bool is_settled = change.leftCols<3>().cwiseAbs().maxCoeff() <= 1e-6 * force_ &&
                            change.rightCols<3>().cwiseAbs().maxCoeff() <= 1e-6 * couple_;
    // NaN never converges: further division is useless.
    if (levels == 1 || is_settled || !change.allFinite()) return sum;
    sum.setZero();
    for (std::size_t k = 0; k < parts.size(); ++k) sum += settled(parts[k], fields[k], levels - 1);
    return sum;
  }

  void note(const CellField& forces) {
    force_ = std::max(force_, forces.leftCols<3>().cwiseAbs().maxCoeff());
    couple_ = std::max(couple_, forces.rightCols<3>().cwiseAbs().maxCoeff());
  }

  mesh::Shape shape_;
  const Integral& integral_;
  double force_ = 0, couple_ = 0;  ///< largest so far [N], [N m]
};

}  // namespace plastron::element
