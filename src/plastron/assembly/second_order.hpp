// Second-order membrane strain that strains linear in u omit: q_ab = 1/2 d_a u . d_b u, sampled and tied as gamma
// (M22), and its energies. With the strain gamma + q the energy of a displacement u is E + work + stretch + ...,
// without bending and shear (docs/theory.md, "What linearity leaves out").
#pragma once
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::assembly {

struct SecondOrder {
  double work = 0;     ///< int N^{ab} q_ab sqrt(a) dx, signed: < 0 where compressed parts rotate [J]
  double stretch = 0;  ///< 1/2 int e a^{abrs} q_ab q_rs sqrt(a) dx [J]
  double largest_strain =
      0;  ///< largest principal strain gamma +- e/2 chi at the faces, by absolute value, at quadrature points
};

/// Computes the quantities from Cartesian nodal values y = (u, r), block 6 with valid ghosts (collective). In all
/// functions here N is the membrane force of the strains of y, less `load_factor` times that of initial strains.
SecondOrder second_order(const ShellOperator& shell, const algebra::Vector& y, double load_factor = 1);

/// Returns the derivative of `work` by y, f . w = int e a^{abrs} q_ab gamma_rs(w) + N^{ab} d_a u . d_b w sqrt(a) dx.
/// The result are nodal forces, complete on owned nodes (collective).
algebra::Vector second_order_forces(const ShellOperator& shell, const algebra::Vector& y, double load_factor = 1);

/// Applies the geometric stiffness of N^{ab}(y): f . w = int N^{ab} d_a v . d_b w sqrt(a) dx, complete on owned nodes
/// (collective).
algebra::Vector geometric_forces(const ShellOperator& shell, const algebra::Vector& y, const algebra::Vector& v,
                                 double load_factor = 1);

/// Returns the rest of `stretch` when the shell also moves by -z: stretch - f . z + 1/2 a(z, z),
/// f = second_order_forces(y). The sum loses no digits where z removes nearly all of `stretch`. The result is least for
/// z = A^-1 f (collective) [J].
double stretch_beside(const ShellOperator& shell, const algebra::Vector& y, const algebra::Vector& z,
                      double load_factor = 1);

}  // namespace plastron::assembly
