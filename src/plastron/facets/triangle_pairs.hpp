// Pairs of triangles that make good quadrilaterals.
#pragma once
#include <plastron/facets/triangles.hpp>

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

namespace plastron::facets {

struct TrianglePair {
  std::array<std::size_t, 2> triangles;
  std::array<int, 4> corners;  ///< of the quadrilateral, in their order round it
};

/// Pairs the triangles on sides that are no pieces of a curve, those with the most right angles first. No angle differs by more than
/// 60 degrees from a right one; some triangles stay alone. `may_pair(corners)`, if given, refuses a quadrilateral.
std::vector<TrianglePair> triangle_pairs(const std::vector<Eigen::Vector3d>& points,
                                         const std::vector<std::array<int, 3>>& triangles,
                                         const std::function<bool(const Ends&)>& is_curve,
                                         const std::function<bool(const std::array<int, 4>&)>& may_pair = {});

}  // namespace plastron::facets
