// Tied nodes, whose values follow from other nodes: v_node = sum weight v_master. A node that hangs on the side of a
// larger cell is interpolated from the nodes there. A node on a joined edge takes the value of its partner. With the
// matrix H of all ties (identity at free nodes), fields are v = H w and forces are transformed by H'.
#pragma once
#include <plastron/fem/space.hpp>

#include <Eigen/Core>

#include <optional>

namespace plastron::fem {

/// v := H v at tied nodes; needs current ghosts, leaves them current.
void spread(const Space& space, algebra::Vector& v);
/// f := H' f on owned nodes, zero at tied ones; f is complete on owned nodes before and after (collective).
void collect(const Space& space, algebra::Vector& f);

/// The free nodes on which a cell's values depend. Values at its nodes are weights times theirs (nodes x carriers).
struct Carriers {
  std::vector<algebra::LocalIndex> nodes;
  Eigen::MatrixXd weights;
};
/// Returns the carriers; nothing if no node of the cell is tied.
std::optional<Carriers> carriers(const Space& space, std::size_t cell);

/// Returns the free nodes of each cell, for the pattern of a matrix; tied nodes have no couplings.
algebra::Connectivity coupled_nodes(const Space& space);

}  // namespace plastron::fem
