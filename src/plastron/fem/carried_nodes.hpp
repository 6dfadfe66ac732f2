// Carried nodes: their (u, r) are combinations of other nodes' values by matrices, y_node = own w_node + sum block
// w_carrier. The ties of ties.hpp have only scalar weights. The nodes of a rigid body are carried by its six motions,
// which are stored at two of its nodes (rigid_bodies.hpp). A node may therefore be carried and carry others. With the
// matrix G of all carried nodes (identity at other nodes) and the matrix H of the ties, y = H G w.
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
  Matrix6 own = Matrix6::Zero();  ///< contribution of its own coordinates
  std::vector<std::pair<algebra::LocalIndex, Matrix6>> carriers{};
};

/// A rigid body on one mesh. The displacement of the first host is d, of the second host length theta.
struct PlacedBody {
  RigidBody body{};
  std::array<algebra::LocalIndex, 2> hosts{-1, -1};  ///< local numbers; -1 where this rank has no node of the body
  double length = 1;                                 ///< from the reference point to the farthest node [m]
  Matrix6 gram = Matrix6::Zero();      ///< sum over its nodes of W' D W, W on (d, length theta), D = diag(1, length^2)
  std::vector<std::size_t> members{};  ///< indices in CarriedNodes::nodes
};

struct CarriedNodes {
  std::vector<CarriedNode>
      nodes{};  ///< carried nodes among all local nodes, ascending; their carriers are local too and not tied
  std::vector<PlacedBody> bodies{};

  const CarriedNode* find(algebra::LocalIndex node) const;
};

/// y := G y; needs current ghosts, leaves them current.
void carry(const Space& space, algebra::Vector& y);
/// f := G' f on owned nodes; f is complete on owned nodes before and after (collective if any rank has carried
/// nodes).
void hand_back(const Space& space, algebra::Vector& f);

/// A matrix for six values of each of its nodes, as a row of blocks.
struct NodeBlocks {
  std::vector<algebra::LocalIndex> nodes{};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix{};
};
/// Transforms the matrix so that it applies to w instead of y = G w.
NodeBlocks on_carriers(const Space& space, NodeBlocks on_nodes);

/// Returns for each cell the nodes on whose coordinates its (u, r) depend, for the pattern of a matrix.
algebra::Connectivity coupled_carriers(const Space& space);

}  // namespace plastron::fem
