// The inf-sup constants of the forms that couple multipliers to the shell, on the discrete spaces:
//   b of (M14)   beta_b = min_q max_V b(V, q) / (|V|_X |grad q|),
//   c of (M19)   beta_c = min_eta max_V c(eta, V) / (|V|_X |eta|),    c(eta, V) = sum_i weight_i eta_i n_i . (v + z s)_i
// with |V|_X of h1_matrix.hpp and L its unit of length: pure numbers, b and c in units of L likewise. The proof of Theorem 5 of the paper measures eta in H^{-1}; L2 is here for comparison.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <optional>

namespace plastron::spectra {

using geometry::Vector3d;

struct ContactInfSup {
  double dual = 0;  ///< |eta|: the norm dual to |w|_1 of scalar nodal fields w that vanish where supports hold the face
  double l2 = 0;    ///< |eta| = (sum_i weight_i eta_i^2)^{1/2}
  std::int64_t multipliers = 0;  ///< nodes with a multiplier
};

/// The inf-sup constant of b for a relaxed formulation. Empty if no support fixes a rotation, because b contains only
/// gradients. `length` is L [m]. (collective) Throws std::runtime_error if the eigenvalue is not found.
std::optional<double> tangency_inf_sup(const assembly::DiscreteShell& discrete, double length);

/// The inf-sup constant of c in the space of the shell's formulation. Each node has a multiplier if the obstacle's normal
/// has a part in the free displacements. Empty without such nodes. (collective) Throws like tangency_inf_sup().
///
/// At these nodes w = n . (v + z s) is a coordinate of V (nodal_coordinates.hpp), so with S w the forces that hold w when
/// the rest of V makes |V|_X smallest,
///   1 / beta_c^2 = max_w w' S w / w' M w,   M the matrix of |w|_1 (dual norm), or of the weights (L2):
/// beta_c is large if every w is the gap of a small V.
std::optional<ContactInfSup> contact_inf_sup(const assembly::DiscreteShell& discrete, double length);

}  // namespace plastron::spectra
