// A mesh as plain values to draw: its cells in the plane of the parameters, the vertices that hang, the zone that touches.
#pragma once
#include <plastron/computation/result.hpp>

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace plastron::study {

/// Points of Omega; the last one is joined to the first.
using Outline = std::vector<Eigen::Vector2d>;

struct MeshPicture {
  std::string caption{};
  std::vector<Outline> cells{};
  std::vector<Eigen::Vector2d> hanging{};  ///< vertices in the middle of a neighbour's side
  std::vector<Outline> touching{};         ///< parts of cells all of whose nodes touch one obstacle
};

/// Around outlines.
Eigen::AlignedBox2d box(const std::vector<Outline>& outlines);

/// The outlines of the cells of all ranks, on every rank, without caption. Their order depends on the ranks (collective).
MeshPicture mesh_picture(const computation::Solution& solution);

}  // namespace plastron::study
