// The true surface at the nodes of cells: positions and normals of the CAD faces on lattices of a degree up to 8.
#pragma once
#include "quads.hpp"

#include <plastron/topology/space_mesh.hpp>

#include <utility>
#include <vector>

namespace plastron::cad {

struct SampledLine {
  std::vector<std::int32_t> nodes;  ///< from end to end
  int edge;                         ///< number in JoinedPart::edges
};

/// How far the polynomials of the cells are from the part, at places between their nodes.
struct SamplingError {
  double distance = 0;   ///< of the surface or of an edge [mm]
  double direction = 0;  ///< of the normal [rad]
};

struct SampledMesh {
  int degree = 1;
  topology::SpaceMesh surface;  ///< [mm]; regions are numbers in JoinedPart::faces, normals those of the faces
  std::vector<SampledLine> lines;
  SamplingError error{};
  double worst_shape = 1;  ///< least sine of the angle between a_1 and a_2; negative: a cell folds over
  Vector3d worst_place = Vector3d::Zero();
  struct BadCell {
    double shape;
    SmallPlace remedy;
  };
  std::vector<BadCell> bad{};  ///< cells with a worse shape than `fair_shape`
};

inline constexpr double fair_shape = 0.05;
inline constexpr double least_shape = 1e-5;  ///< of a cell that can be used

/// Returns the worst shape at the nodes of the cells, and its place.
std::pair<double, Vector3d> worst_shape(const SampledMesh& sampled);

/// Samples with degree 2, which shows the shapes of the cells.
SampledMesh sampled_coarsely(const JoinedPart& part, const Quads& quads);

/// Samples with the lowest degree of 1, 2, 4, 6 and 8 whose error is below what the estimate of an error could see.
SampledMesh sampled(const JoinedPart& part, const Quads& quads, double diagonal);

}  // namespace plastron::cad
