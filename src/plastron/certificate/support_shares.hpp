// Who carries the force of the supports at a node: boundaries, corners between boundaries, points.
//
// A boundary, or a point, carries forces only in directions that its own supports hold. A direction that a boundary and a point hold is the
// boundary's. A direction that two boundaries hold is shared: by length of edge where they run on into each other; at a corner the edges have what
// their own line densities have there, and the rest is the corner's. In Kirchhoff's plates that rest is a force at a point, the jump of M_nt (Timoshenko
// and Woinowsky-Krieger, Theory of Plates and Shells, 1959, section 22); in Naghdi's model it is spread over a length of about e/2 along the edges.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace plastron::certificate {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Where edges meet at an angle that supports hold in one direction at least.
struct SupportCorner {
  std::vector<std::size_t> boundaries{};            ///< of SupportShares::boundaries(), ascending
  Eigen::Vector2d at = Eigen::Vector2d::Zero();     ///< in Omega
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< on the mid-surface [m]
  double reach = 0;                                 ///< how far along the edges its force is spread [m]
  Matrix6 shared = Matrix6::Zero();  ///< projector on the directions of (u, r) that several of its edges hold
};

class SupportShares {
 public:
  /// (collective)
  explicit SupportShares(const assembly::DiscreteShell& discrete);

  /// Names that supports have, in the order of the case. They are the first carriers, then come corners(), then points.
  const std::vector<std::string>& boundaries() const { return boundaries_; }
  /// In an order of places; the same on all ranks.
  const std::vector<SupportCorner>& corners() const { return corners_; }
  std::size_t carriers() const { return boundaries_.size() + corners_.size() + points_; }

  /// What a carrier has of (force, couple) of the supports at an owned node. All parts together make the whole of all nodes' forces.
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

}  // namespace plastron::certificate
