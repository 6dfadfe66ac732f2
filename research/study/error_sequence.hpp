// The errors of every mesh level against a solution some levels finer. The spaces are nested, so a coarse solution is
// carried to the reference mesh exactly, and there the difference is integrated; its strains are those of its own mesh.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/problem/problem.hpp>
#include <research/study/falk.hpp>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace plastron::study {

/// Norms of a field, or of an error relative to the reference's.
struct Norms {
  double energy = 0, h1 = 0, l2 = 0, h1_u = 0, h1_r = 0, l2_u = 0, l2_r = 0;
};

constexpr std::array norm_of{&Norms::energy, &Norms::h1,   &Norms::l2,  &Norms::h1_u,
                             &Norms::h1_r,   &Norms::l2_u, &Norms::l2_r};

/// The levels of one problem and their errors.
struct ErrorSequence {
  contact::Status status = contact::Status::solved;
  std::vector<computation::Level> levels{};  ///< with those finer than what is compared
  std::vector<double> h{};                   ///< of the levels compared [m]
  std::vector<Norms> errors{};               ///< of the levels compared; relative, where the reference is not zero
  /// Both sides of Falk's estimate on the levels compared, in |U|_a^2; empty where it cannot be evaluated, for this reason.
  std::vector<FalkTerms> falk{};
  std::string why_without_falk{};
  double energy_norm = 0;  ///< |U|_a of the reference [J^{1/2}]
  double noise = 0;        ///< relative errors in the energy norm below it are rounding

  std::vector<double> of(double Norms::*norm) const;
};

/// `reference` levels more than the problem's are solved; H1 and L2 take `length` [m] as unit of length. (collective)
ErrorSequence error_sequence(problem::Problem problem, int reference, double length, MPI_Comm comm,
                             computation::Observer observer);

}  // namespace plastron::study
