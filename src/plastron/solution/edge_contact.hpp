// Contact along the edges of the shell. There the reaction may be concentrated on a line [N/m] (docs/model.md,
// section 6), for example where a bowl turned over stands on its rim. Nodal reactions then decrease like h and not
// like h^2, and a pressure would double with each refinement. The nodal reaction over the node's length of edge
// converges.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

namespace plastron::solution {

using Eigen::MatrixXd;
using geometry::Vector3d;

struct EdgeContact {
  std::int64_t nodes = 0;      ///< touching nodes on edges of the shell
  double force = 0;            ///< sum of their nodal reactions [N]
  double area = 0;             ///< mid-surface area represented by them [m^2]
  double max_per_length = 0;   ///< largest nodal reaction over its length of edge [N/m]
  double pressure_inside = 0;  ///< largest eta at the touching nodes that lie on no edge [Pa]

  /// Whether the edge carries a line reaction: its mean pressure is far above all pressure inside and is no density.
  bool is_line() const;
};

/// Computes the contact along edges (collective).
EdgeContact edge_contact(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::solution
