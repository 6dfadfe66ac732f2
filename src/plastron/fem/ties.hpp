// Nodes whose values follow from those of others: v_node = sum weight v_master. A node that hangs on the side of a larger cell is an
// interpolation of the nodes there; a node on an edge that is joined to another edge takes the value of its partner.
// With H the matrix of all this (identity at nodes that are free), fields are v = H w and forces go back by H'.
#pragma once
#include <plastron/fem/space.hpp>

#include <Eigen/Core>

#include <optional>

namespace plastron::fem {

/// v := H v at tied nodes; needs current ghosts, leaves them current.
void spread(const Space& space, algebra::Vector& v);
/// f := H' f on owned nodes, zero at tied ones; f is complete on owned nodes before and after (collective).
void collect(const Space& space, algebra::Vector& f);

/// The free nodes that a cell's values depend on: values at its nodes are weights times those (nodes x carriers).
struct Carriers {
  std::vector<algebra::LocalIndex> nodes;
  Eigen::MatrixXd weights;
};
/// Nothing if no node of the cell is tied.
std::optional<Carriers> carriers(const Space& space, std::size_t cell);

/// The free nodes of each cell, for the pattern of a matrix; tied nodes are coupled with nothing.
algebra::Connectivity coupled_nodes(const Space& space);

}  // namespace plastron::fem
