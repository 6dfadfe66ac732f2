// The motions of a shell that cost least energy for their size: the smallest theta of
//   a(V, W) = theta (V, W)_X  for all W,    (., .)_X of h1_matrix.hpp, a(., .) with the form of normal_rotation.hpp in relaxed formulations.
// The first is the constant alpha of coercivity (Lemmas 2 and 3 of the paper). Without supports six vanish with the mesh
// size, the rigid motions, and in relaxed formulations a seventh on developable surfaces.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <string_view>
#include <vector>

namespace plastron::spectra {

using geometry::Vector3d;

/// The kind of motion that dominates a mode.
enum class ModeKind {
  translation,      ///< u = c
  rotation,         ///< u = w x (phi - c), r = w x a_3, less its part among the translations
  normal_rotation,  ///< r . a_3 is constant and not zero
  deformation
};
std::string_view to_string(ModeKind kind);

struct Mode {
  double stiffness = 0;        ///< theta = a(V, V) / |V|_X^2 through strains [J]; 0 if below rounding
  double translation = 0;      ///< share of |V|_X^2 in the translations
  double rotation = 0;         ///< share in the rotations that is not in the translations
  double normal_rotation = 0;  ///< share of int |r|^2 in constant multiples of a_3

  ModeKind kind() const;
};

/// Ascending. Modes that all cost nothing are turned among themselves so that translations come first, then rotations, then
/// the rest. `length` is L of the norm [m]. Precondition: no obstacle, whose nodal coordinates are not orthonormal.
/// (collective) Throws std::runtime_error if the eigenvalues do not converge.
std::vector<Mode> softest_modes(const assembly::DiscreteShell& discrete, int count, double length);

}  // namespace plastron::spectra
