// A part of the potential beside the strain energy of the shell (M31): a function of the nodal values y = (u, r), most often a quadratic
// form. Its energy, its forces and its stiffness have the same names in all terms; the discrete shell adds them up and names none of them.
#pragma once
#include <plastron/constraints/map.hpp>
#include <plastron/energy/shell_operator.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace plastron::energy {

class Term {
 public:
  Term() = default;
  Term(const Term&) = delete;
  Term& operator=(const Term&) = delete;
  virtual ~Term() = default;

  /// Whether the term belongs to the formulation, such as a penalty, and stores no energy of the shell or of its surroundings.
  virtual bool is_artificial() const { return false; }
  /// Whether the forces act on a rigid body. Those on its nodes then stand for a force and a couple that move with it.
  virtual bool is_on_body() const { return false; }
  /// Returns the energy, 1/2 y . K y of a quadratic form. Needs y's ghosts (collective) [J].
  virtual double energy(const ShellOperator& shell, const algebra::Vector& y) const = 0;
  /// Adds the derivative of the energy, of this rank's cells, to f's local values. Needs y's ghosts. f.accumulate_ghosts() then completes
  /// the sum (collective).
  virtual void add_forces(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& f) const = 0;
  /// Adds K v for a motion v likewise, K the second derivative at a state, which may be without layout: the reference (collective).
  virtual void add_product(const ShellOperator& shell, const algebra::Vector& /*state*/, const algebra::Vector& v,
                           algebra::Vector& f) const {
    add_forces(shell, v, f);
  }
  /// Returns K of an owned cell, on (u, r) of its nodes; nothing where the term does not act.
  virtual std::optional<RowMatrix> stiffness(const ShellOperator& shell, std::size_t cell) const = 0;
  /// Returns the rest of K at a state: matrices on (u, r) of nodes of several cells, which Space::couplings() contains.
  virtual std::vector<constraints::NodeColumns> stiffness_between_cells(const ShellOperator& /*shell*/,
                                                                        const algebra::Vector& /*state*/) const {
    return {};
  }
  /// Returns K on (d, length theta) of a rigid body at a state; nothing where the term does not act (collective).
  virtual std::optional<constraints::Matrix6> stiffness_of_body(const ShellOperator& /*shell*/, std::size_t /*body*/,
                                                                const algebra::Vector& /*state*/) const {
    return {};
  }
};

using Terms = std::vector<std::shared_ptr<const Term>>;

}  // namespace plastron::energy
