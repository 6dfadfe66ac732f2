// What the edge of a contact zone adds to the error of a functional. It lies somewhere inside of the cells that it crosses, where the
// reaction jumps and nothing is smooth; two terms there are multipliers times how far nodes fail to speak for what is between them,
//   < mu, g(u_h) >   and   < eta, B z_h - w >,
// mu and eta the reactions of dual and solution, g(u_h) the gap, w the values at which the dual is held. Like the product of strain errors
// they are known by size, not by sign (docs/methods/estimates.md).
#pragma once
#include <plastron/estimation/derivatives.hpp>

#include <vector>

namespace plastron::estimation {

class ContactEdge {
 public:
  explicit ContactEdge(const Solved& solved);

  /// Owned cells in which some nodes touch an obstacle and some do not, ascending.
  const std::vector<std::size_t>& crossed() const { return crossed_; }
  /// How many nodes of each of those touch, of the first obstacle that one is crossed for. Where between nodes the edge lies decides about the sign of what it adds: cells of one number err
  /// to the same side, as all cells along a straight edge do, others by chance.
  const std::vector<std::size_t>& touching_nodes() const { return touching_nodes_; }
  /// Along which of its directions, 0 or 1, more neighbouring nodes of each of those differ in touching: the edge runs across it. 0 in triangles.
  const std::vector<int>& across() const { return across_; }
  /// The larger of both terms in each crossed cell, without its sign; `y` are the Cartesian values of z (collective).
  std::vector<double> shares(const Derivative& derivative, const algebra::Vector& z, const algebra::Vector& y) const;

 private:
  struct Reactions {
    std::vector<double> mu, eta;  ///< by local node and obstacle, per unit area
  };
  std::vector<double> densities(const algebra::Vector& multiplier) const;
  double share(std::size_t cell, std::size_t obstacle, const Derivative& derivative, const element::CellField& z,
               const Reactions& reactions) const;
  int direction_across(std::size_t cell, std::size_t obstacle) const;
  bool touches(std::size_t node, std::size_t obstacle) const;

  const Solved& solved_;
  std::vector<double> eta_{};
  std::vector<std::size_t> crossed_{}, touching_nodes_{};
  std::vector<int> across_{};
  Eigen::MatrixXd reaction_basis_;
};

}  // namespace plastron::estimation
