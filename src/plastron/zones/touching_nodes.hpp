// Nodes that count as touching one obstacle in zones and their boundaries, and the place between a touching and a
// free node where the gap closes.
//
// At the edge of a zone the gap and its slope vanish and the curvature jumps (docs/model.md, section 6). Outside, the
// root of the gap is therefore linear in the distance from the edge. At each free node a plane is fitted to the roots
// of its free neighbours. Touching nodes have the mean of the planes of their free neighbours, which is negative. The
// edge is about where the root is zero; gap_opening.hpp refines its place. Vertices of triangles of degree 2 have no
// bound (M21: their nodal weight is 0): they count as touching where most of their neighbours touch.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <span>
#include <vector>

namespace plastron::zones {

using geometry::Vector3d;

/// The node that represents all nodes identified with it across joined edges.
algebra::LocalIndex representative(const fem::Space& space, algebra::LocalIndex node);

class TouchingNodes {
 public:
  /// Marks the touching nodes of one obstacle (collective).
  TouchingNodes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, std::size_t obstacle);

  /// Whether a local node touches.
  bool operator[](algebra::LocalIndex node) const { return inside_[static_cast<std::size_t>(node)] != 0; }
  /// 1 for touching local nodes, 0 for free ones.
  std::span<const char> inside() const { return inside_; }
  /// The root of the gap at local nodes, continued with negative values to touching nodes at the zone's edge; 0
  /// farther inside [m^1/2].
  std::span<const double> roots() const { return root_; }
  /// The place where the zone's edge crosses the line from a free to a touching node: 0 at the free, 1 at the
  /// touching node.
  double crossing(algebra::LocalIndex free, algebra::LocalIndex touching) const;

 private:
  void judge_nodes_without_bound(const assembly::DiscreteShell& discrete);
  /// Marks single free nodes among touching ones: elements wider than the layer at the edge lift these nodes behind
  /// it.
  void take_in_lifted_nodes(const assembly::DiscreteShell& discrete);
  void fit_slopes(const assembly::DiscreteShell& discrete);
  void continue_roots(const assembly::DiscreteShell& discrete);

  std::vector<char> inside_{};
  std::vector<double> root_{};     // roots of the gap, continued with negative values to touching nodes [m^1/2]
  std::vector<Vector3d> slope_{};  // slopes of the root at free nodes, in space; zero without free neighbours
  std::vector<Vector3d> place_{};  // phi
};

}  // namespace plastron::zones
