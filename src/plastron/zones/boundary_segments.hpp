// The boundary of the zones in each sub-cell, and the area inside. The boundary has straight segments between the
// points on the sub-cell's sides where the gap closes (marching squares and triangles). It also contains the parts of
// the shell's rim in contact.
#pragma once
#include <plastron/solution/contact_zone.hpp>
#include <plastron/zones/sub_cells.hpp>
#include <plastron/zones/touching_nodes.hpp>

#include <array>
#include <vector>

namespace plastron::zones {

struct SegmentEnd {
  std::array<algebra::GlobalIndex, 2> nodes{};  ///< nodes on both sides of the end; equal if the end is a node
  /// The same nodes, but nodes identified across joined edges have one number.
  std::array<algebra::GlobalIndex, 2> names{};
  /// Largest distance between the ends that the two cells of a side with hanging nodes find for one line [m]; 0
  /// elsewhere.
  double reach = 0;
  solution::BoundaryPoint point{};
};

struct Segment {
  int zone = 0;
  bool is_rim = false;
  std::array<SegmentEnd, 2> ends{};
};

struct ZoneBoundaries {
  std::vector<Segment> segments{};  ///< segments of all ranks, on every rank; their order depends on the ranks
  /// Mid-surface area within each zone's boundary [m^2]. Between the ends of a segment the boundary is a parabola
  /// through the edge that free nodes predict near its middle.
  std::vector<double> areas{};
};

/// Computes the boundaries of one obstacle's zones (collective). Throws the exceptions of the chart.
ZoneBoundaries zone_boundaries(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                               std::size_t obstacle, const TouchingNodes& touching, const ZoneLabels& labels);

/// Returns the polylines joined from the segments of one zone, in an order that depends only on their places: inside
/// the shell first, then along the rim; long before short. Where a line crosses a joined edge, it has the same place
/// twice, with the parameters of either side. `size`: size of the shell [m].
std::vector<solution::ContactLine> contact_lines(const std::vector<Segment>& segments, double size);

}  // namespace plastron::zones
