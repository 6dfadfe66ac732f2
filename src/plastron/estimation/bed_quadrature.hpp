// Contribution of the quadrature at nodes (M21) of the pressure of a bed (M33) to the error of a functional:
//   J(u) - J(u_h) contains  int p(s_h) (B z - w) dS - sum_i a_i p_i (B z - w)_i,
// z the dual, w the values at which it is fixed, s_h the closure of the approximate shell. Pressures have kinks where the zone ends and
// at the points of a table; a cell that has one is integrated on small parts.
#pragma once
#include <plastron/estimation/derivatives.hpp>

#include <vector>

namespace plastron::estimation {

class BedQuadrature {
 public:
  /// Integrates the pressure over the cells (collective).
  explicit BedQuadrature(const Solved& solved);

  /// Adds the shares of owned cells and returns the root of the sum of squares of those with a kink (collective): the kink's place is
  /// that of the approximate shell, so they may err by their size. `y`: the Cartesian values of the dual, with ghosts.
  double add_shares(const Derivative& derivative, const DualSolution& dual, const algebra::Vector& y,
                    std::vector<double>& cells) const;

 private:
  struct NodalForce {
    std::size_t node = 0;
    double size = 0;  ///< pressure times the part of the node's area in the cell [N]
  };
  struct Pressed {
    std::size_t cell = 0;
    bool has_kink = false;
    element::CellField forces{};                          ///< of the pressure on the cell's nodes, along (u, r)
    std::vector<NodalForce> nodal{};                      ///< of the quadrature at nodes
    Eigen::Vector3d resultant = Eigen::Vector3d::Zero();  ///< of `forces` less that of `nodal` [N]
  };
  std::vector<NodalForce> nodal_forces(std::size_t cell) const;
  /// Whether closures at the cell's nodes and points lie on different segments of the law, or some are open.
  bool has_kink(std::size_t cell, const Eigen::VectorXd& gaps) const;

  const Solved& solved_;
  std::size_t obstacle_ = 0;
  std::vector<Pressed> cells_{};
};

}  // namespace plastron::estimation
