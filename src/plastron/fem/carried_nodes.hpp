// Nodes whose (u, r) are combinations of others' by matrices, where ties.hpp knows numbers only: y_node = own w_node + sum block w_carrier.
// The nodes of a rigid body are carried by its six motions, which stand in the places of two of its nodes (rigid_bodies.hpp); so a
// node may be carried and carry others. With G the matrix of all this (identity at other nodes) and H that of the ties, y = H G w.
#pragma once
#include <plastron/fem/rigid_bodies.hpp>
#include <plastron/fem/space.hpp>

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

namespace plastron::fem {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct CarriedNode {
  algebra::LocalIndex node = 0;
  Matrix6 own = Matrix6::Zero();  ///< what of its own coordinates moves it
  std::vector<std::pair<algebra::LocalIndex, Matrix6>> carriers{};
};

/// A rigid body on one mesh. The first host's displacement is d, the second's is length theta.
struct PlacedBody {
  RigidBody body{};
  std::array<algebra::LocalIndex, 2> hosts{-1, -1};  ///< local numbers; -1 where this rank sees no node of the body
  double length = 1;                                 ///< from the reference point to the farthest node [m]
  Matrix6 gram = Matrix6::Zero();      ///< sum over its nodes of W' D W, W on (d, length theta), D = diag(1, length^2)
  std::vector<std::size_t> members{};  ///< places in CarriedNodes::nodes
};

struct CarriedNodes {
  std::vector<CarriedNode>
      nodes{};  ///< of all local nodes, ascending; their carriers are local, too. Carriers are not tied.
  std::vector<PlacedBody> bodies{};

  const CarriedNode* find(algebra::LocalIndex node) const;
};

/// y := G y; needs current ghosts, leaves them current.
void carry(const Space& space, algebra::Vector& y);
/// f := G' f on owned nodes; f is complete on owned nodes before and after (collective where nodes are carried).
void hand_back(const Space& space, algebra::Vector& f);

/// A matrix on six values of each of its nodes, a row of blocks.
struct NodeBlocks {
  std::vector<algebra::LocalIndex> nodes{};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix{};
};
/// The same matrix on w in place of y = G w.
NodeBlocks on_carriers(const Space& space, NodeBlocks on_nodes);

/// The nodes on whose coordinates the (u, r) of each cell depend, for the pattern of a matrix.
algebra::Connectivity coupled_carriers(const Space& space);

}  // namespace plastron::fem
