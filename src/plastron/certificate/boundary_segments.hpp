// The boundary of the zones as each sub-cell sees it: straight segments between the points where the gap closes on its sides
// (marching squares and triangles), and the parts of the shell's rim that zones reach; and the area within.
#pragma once
#include <plastron/certificate/contact_zone.hpp>
#include <plastron/certificate/touching_nodes.hpp>
#include <plastron/certificate/zone_labels.hpp>

#include <array>
#include <vector>

namespace plastron::certificate {

struct SegmentEnd {
  std::array<algebra::GlobalIndex, 2> nodes{};  ///< between which it lies; equal at a node
  std::array<algebra::GlobalIndex, 2> names{};  ///< the same with nodes that are one across joined edges by one number
  double reach = 0;  ///< where nodes hang, the two cells of a side see points of it so far from each other at most [m]
  BoundaryPoint point{};
};

struct Segment {
  int zone = 0;
  bool is_rim = false;
  std::array<SegmentEnd, 2> ends{};
};

struct ZoneBoundaries {
  std::vector<Segment> segments{};  ///< of all ranks on every rank; their order depends on the ranks
  /// Of each zone: of the mid-surface within its boundary, which bulges from segment to segment like a parabola through the point where free
  /// nodes see the edge halfway [m^2].
  std::vector<double> areas{};
};

/// Of one obstacle's zones (collective). Throws what the chart throws.
ZoneBoundaries zone_boundaries(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                               std::size_t obstacle, const TouchingNodes& touching, const ZoneLabels& labels);

}  // namespace plastron::certificate
