// Which nodes count as touching one obstacle when zones and their boundaries are drawn, and where between a touching and a free node
// the gap closes.
//
// Gap and slope vanish at the edge of a zone and the curvature jumps there (docs/model.md, section 6), so outside the root of the gap
// is linear in the distance from the edge. At a free node a plane is put through the roots of its free neighbours; touching nodes
// have the mean of the planes of their free neighbours, which is negative, and the edge is about where the root is zero; gap_opening.hpp
// finds it from there. Vertices of triangles of degree 2 have no bound (M21: their nodal weight is 0): they
// count as touching where most of their neighbours touch.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <span>
#include <vector>

namespace plastron::certificate {

using geometry::Vector3d;
struct NodalSolution;

/// The node that stands for all those that are one across joined edges.
algebra::LocalIndex representative(const fem::Space& space, algebra::LocalIndex node);

class TouchingNodes {
 public:
  /// (collective)
  TouchingNodes(const assembly::DiscreteShell& discrete, const NodalSolution& solution, std::size_t obstacle);

  /// Of a local node.
  bool operator[](algebra::LocalIndex node) const { return inside_[static_cast<std::size_t>(node)] != 0; }
  /// 1 or 0 of local nodes.
  std::span<const char> inside() const { return inside_; }
  /// The root of the gap at local nodes, continued with negative values to touching nodes at the zone's edge; 0 farther inside [m^1/2].
  std::span<const double> roots() const { return root_; }
  /// Where the edge of the zone crosses the line from a free node to a touching one: 0 at the free, 1 at the touching node.
  double crossing(algebra::LocalIndex free, algebra::LocalIndex touching) const;

 private:
  void judge_nodes_without_bound(const assembly::DiscreteShell& discrete);
  /// Single free nodes among touching ones: elements wider than the layer at the edge lift them off behind it.
  void take_in_lifted_nodes(const assembly::DiscreteShell& discrete);
  void fit_slopes(const assembly::DiscreteShell& discrete);
  void continue_roots(const assembly::DiscreteShell& discrete);

  std::vector<char> inside_{};
  std::vector<double> root_{};     // of the gap, continued with negative values to touching nodes [m^1/2]
  std::vector<Vector3d> slope_{};  // of the root at free nodes, in space; zero where no free neighbour tells
  std::vector<Vector3d> place_{};  // phi
};

}  // namespace plastron::certificate
