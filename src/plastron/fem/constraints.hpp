// Constraints between nodes. A constrained node has no unknowns of its own, or fewer than six. Two linear maps give
// all nodal values y = H G w from the unconstrained ones:
//   H  ties, v_node = sum weight v_master: a node that hangs on the side of a larger cell is interpolated from the
//      nodes there, a node on a joined edge takes the value of its partner;
//   G  carried nodes, (u, r)_node = own w_node + sum block w_carrier with 6 x 6 matrices: nodes of rigid bodies and of
//      shells joined at an angle. A node may be carried and carry others.
// Both are the identity at other nodes. Forces are transformed by the transposed maps.
#pragma once
#include <plastron/fem/surface.hpp>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// A hanging node with its masters, which may hang too, on the side of a still larger cell.
struct HangingNode {
  algebra::GlobalIndex node = 0;
  std::vector<std::pair<algebra::GlobalIndex, double>> masters{};  ///< at most degree + 1
};
/// Ties the hanging nodes of a space that has no ties yet (collective). `owned`: all hanging nodes that this rank
/// owns. Adds missing masters to the layout as ghosts.
void tie_hanging_nodes(Space& space, const std::vector<HangingNode>& owned);

/// Two boundaries of the mesh that coincide in space and are joined. A rectangle is closed to a tube this way, and
/// pieces with separate charts form one shell.
struct Join {
  std::array<std::string, 2> boundaries;
};
/// Returns the space in which the nodes on joined edges are tied to one node of each place (collective). Throws
/// DomainError on all ranks if a boundary does not exist, if a node has no partner at the same place, or if normals
/// are opposite.
///
/// Shells that meet at an angle (a kink) share the displacement of the edge and one rotation vector omega, r_i = omega
/// x a_3i. A shell's rotation does not contain the part of omega along its own normal. Therefore two shells share only
/// omega . t, t the edge's tangent:
///   u_2 = u_1,   r_2 . (t x a_32) = r_1 . (t x a_31).
/// The node of the second shell is carried by the node of the first and keeps r_2 . t as its own coordinate.
std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins);

/// A rigid body that carries edges of the shell. At each of their nodes u = d + theta x (phi - reference) and r =
/// theta x a_3, a motion without strain. Each of the six numbers (d, theta) is an unknown of the system or prescribed.
struct RigidBody {
  std::string name{};
  std::vector<std::string> boundaries{};                ///< boundaries whose nodes it carries
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< reference point [m]
  bool turns_normals = true;                            ///< false: a hinge; r stays free in the shell
  std::array<std::optional<double>, 6> fixed{};         ///< prescribed components of d [m], then theta [rad]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< force at the reference point [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();     ///< moment about the reference point [N m]
};
/// Returns the space in which bodies carry the nodes of their boundaries (collective). Throws DomainError on all
/// ranks if a boundary does not exist, if two bodies carry one node, and if a hinge can turn freely about the line of
/// its nodes.
std::shared_ptr<const Space> with_rigid_bodies(std::shared_ptr<const Space> space, const Surface& surface,
                                               const std::vector<RigidBody>& bodies);

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct CarriedNode {
  algebra::LocalIndex node = 0;
  Matrix6 own = Matrix6::Zero();  ///< contribution of its own coordinates
  std::vector<std::pair<algebra::LocalIndex, Matrix6>> carriers{};
};

/// A rigid body on one mesh. Its six motions are stored at two of its nodes, the hosts: the displacement of the first
/// host is d, of the second host length theta.
struct PlacedBody {
  RigidBody body{};
  std::array<algebra::LocalIndex, 2> hosts{-1, -1};  ///< local numbers; -1 where this rank has no node of the body
  double length = 1;                                 ///< from the reference point to the farthest node [m]
  Matrix6 gram = Matrix6::Zero();      ///< sum over its nodes of W' D W, W on (d, length theta), D = diag(1, length^2)
  std::vector<std::size_t> members{};  ///< indices in CarriedNodes::nodes
};

struct CarriedNodes {
  /// All local nodes that are carried, ascending. Their carriers are local too and not tied. The first carrier of a
  /// node at a kink determines its u.
  std::vector<CarriedNode> nodes{};
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

/// Whether a node is carried across a kink and not by a rigid body.
bool is_kinked(const CarriedNodes& carried, const CarriedNode& node);
/// Adds each kinked node's value to the node that determines its u, and sets it to zero. For scalar fields
/// (collective if any rank has carried nodes).
void collect_at_kinks(const Space& space, algebra::Vector& values);

/// d [m] and theta [rad].
struct BodyMotion {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
};
/// Returns the motion nearest to the displacements of the body's nodes, with prescribed components unchanged
/// (collective).
BodyMotion motion_of(const Space& space, const PlacedBody& body, const algebra::Vector& y);
/// Adds nodal forces on owned nodes that do the work of the body's force and moment in each of its motions. Among all
/// such forces they are the smallest.
void add_body_load(const Space& space, const PlacedBody& body, algebra::Vector& f);

}  // namespace plastron::fem
