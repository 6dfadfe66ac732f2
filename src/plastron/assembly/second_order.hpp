// What strains linear in u leave out of the membrane strain: q_ab = 1/2 d_a u . d_b u, sampled and tied as gamma is (M22), and the
// energies that belong to it. With the strain gamma + q the energy of a displacement u is E + work + stretch + ..., bending and shear
// apart (docs/theory.md, "What linearity leaves out").
#pragma once
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::assembly {

struct SecondOrder {
  double work = 0;     ///< int N^{ab} q_ab sqrt(a) dx, signed: < 0 where compressed parts turn [J]
  double stretch = 0;  ///< 1/2 int e a^{abrs} q_ab q_rs sqrt(a) dx [J]
  double largest_strain =
      0;  ///< largest principal strain gamma +- e/2 chi at the faces, by its size, at quadrature points
};

/// Takes Cartesian nodal values y = (u, r), block 6 with valid ghosts (collective).
SecondOrder second_order(const ShellOperator& shell, const algebra::Vector& y);

/// The derivative of `work` by y, f . w = int e a^{abrs} q_ab gamma_rs(w) + N^{ab} d_a u . d_b w sqrt(a) dx: nodal forces, complete on
/// owned nodes (collective).
algebra::Vector second_order_forces(const ShellOperator& shell, const algebra::Vector& y);

/// The geometric stiffness of N^{ab}(y): f . w = int N^{ab} d_a v . d_b w sqrt(a) dx, complete on owned nodes (collective).
algebra::Vector geometric_forces(const ShellOperator& shell, const algebra::Vector& y, const algebra::Vector& v);

/// What of `stretch` is left where the shell also moves by -z: stretch - f . z + 1/2 a(z, z), f = second_order_forces(y), summed so that
/// no digits are lost where z takes nearly all of it back. Least for z = A^-1 f (collective) [J].
double stretch_beside(const ShellOperator& shell, const algebra::Vector& y, const algebra::Vector& z);

}  // namespace plastron::assembly
