// Distribution of the supports' force at a node among boundaries, corners between boundaries, and points.
//
// A boundary or a point carries forces only in directions that its own supports fix. A direction fixed by a boundary
// and a point belongs to the boundary. A direction fixed by two boundaries is shared. Where the boundaries continue
// each other, the shares are in proportion to length of edge. At a corner each edge carries the force of its own line
// density there, and the corner carries the rest. In Kirchhoff's plates the rest is a force at a point, the jump of
// M_nt (Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, 1959, section 22). In Naghdi's model it is
// spread over a length of about e/2 along the edges.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace plastron::solution {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A corner where edges meet at an angle, with at least one direction fixed by supports of several edges.
struct CornerPlace {
  std::size_t edges = 0;                            ///< number of these edges
  Eigen::Vector2d at = Eigen::Vector2d::Zero();     ///< in Omega
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< on the mid-surface [m]
  double reach = 0;                                 ///< length along the edges over which its force is spread [m]
  Matrix6 shared = Matrix6::Zero();  ///< projector on the directions of (u, r) fixed by several of its edges
};
struct SupportCorner : CornerPlace {
  std::vector<std::size_t> boundaries{};  ///< places in SupportShares::boundaries(), ascending
};

class SupportShares {
 public:
  /// Finds corners and shares (collective).
  explicit SupportShares(const assembly::DiscreteShell& discrete);

  /// Names of boundaries with supports, in the order of the case. They are the first carriers; corners() and points
  /// follow.
  const std::vector<std::string>& boundaries() const { return boundaries_; }
  /// Corners in an order of places that is the same on all ranks.
  const std::vector<SupportCorner>& corners() const { return corners_; }
  std::size_t carriers() const { return boundaries_.size() + corners_.size() + points_; }

  /// A carrier's share of (force, couple) of the supports at an owned node. The sum of all shares is the sum of all
  /// nodes' forces.
  struct Share {
    std::size_t carrier = 0;
    Matrix6 part = Matrix6::Zero();
  };
  const std::vector<Share>& at(std::size_t node) const;

 private:
  struct Holding;
  using Holdings = std::map<std::size_t, std::vector<Holding>>;

  Holdings holdings(const assembly::DiscreteShell& discrete) const;
  void find_corners(const assembly::DiscreteShell& discrete, const Holdings& all);
  void share(const assembly::DiscreteShell& discrete, const Holdings& all);

  std::vector<std::string> boundaries_{};
  std::vector<SupportCorner> corners_{};
  std::size_t points_ = 0;
  std::map<std::size_t, std::vector<Share>> shares_{};
};

}  // namespace plastron::solution
