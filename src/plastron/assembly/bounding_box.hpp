// The axis-parallel box around points of all ranks.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <Eigen/Core>

#include <limits>

namespace plastron::assembly {

struct BoundingBox {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;

  double half_diagonal() const { return (high - low).norm() / 2; }
  double longest_side() const { return (high - low).maxCoeff(); }
};

/// Returns the box around place(0), ..., place(count - 1) of all ranks (collective).
template <class Place>
BoundingBox bounding_box(std::size_t count, const Place& place, MPI_Comm comm) {
  BoundingBox box;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d at = place(i);
    box.low = box.low.cwiseMin(at);
    box.high = box.high.cwiseMax(at);
  }
  for (int k = 0; k < 3; ++k) {
    box.low[k] = algebra::min_over_ranks(box.low[k], comm);
    box.high[k] = algebra::max_over_ranks(box.high[k], comm);
  }
  return box;
}

}  // namespace plastron::assembly
