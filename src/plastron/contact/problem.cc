#include <plastron/contact/problem.hpp>

#include <array>

namespace plastron::contact {

std::span<const Status> statuses() {
  using enum Status;
  static constexpr std::array all{solved,
                                  iteration_limit,
                                  cycling,
                                  infeasible,
                                  singular,
                                  not_held,
                                  not_carried,
                                  linear_solver_stalled,
                                  not_finite,
                                  interrupted,
                                  gap_not_met,
                                  no_equilibrium,
                                  unstable,
                                  inaccurate,
                                  accuracy_not_reached};
  static_assert(all.size() == static_cast<std::size_t>(accuracy_not_reached) + 1, "it is the last");
  return all;
}

std::string_view to_string(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::iteration_limit:
      return "iteration_limit";
    case Status::cycling:
      return "cycling";
    case Status::infeasible:
      return "infeasible";
    case Status::singular:
      return "singular";
    case Status::not_held:
      return "not_held";
    case Status::not_carried:
      return "not_carried";
    case Status::linear_solver_stalled:
      return "linear_solver_stalled";
    case Status::not_finite:
      return "not_finite";
    case Status::inaccurate:
      return "inaccurate";
    case Status::interrupted:
      return "interrupted";
    case Status::gap_not_met:
      return "gap_not_met";
    case Status::no_equilibrium:
      return "no_equilibrium";
    case Status::unstable:
      return "unstable";
    case Status::accuracy_not_reached:
      return "accuracy_not_reached";
  }
  return "unknown";
}

std::string_view explain(Status status) {
  switch (status) {
    case Status::solved:
      return "Solved: no penetration at nodes, no tensile contact pressure.";
    case Status::iteration_limit:
      return "The active set still changed when the iterations ran out; start from a coarser mesh or a smaller load, "
             "or allow more iterations.";
    case Status::cycling:
      return "The same active sets came back and the energy could not be lowered beyond rounding; loosen the "
             "tolerances of gap and multiplier, or start from a coarser mesh.";
    case Status::infeasible:
      return "There is no room for the structure: obstacles are nearer to each other than it is thick, a support "
             "presses it "
             "into an obstacle, or a force presses one obstacle through it onto another; move the obstacles or the "
             "support, or use a smaller force.";
    case Status::singular:
      return "A motion costs no energy and no bound stops it; add a support that holds the structure.";
    case Status::not_held:
      return "Contact alone would hold the structure, and nothing stops it: the loads pull it off, let it tip over, or "
             "are in balance without contact; add a support against that motion, or loads that press it on. In a very "
             "thin shell it may be rounding that looks like such a motion: then the system is too ill-conditioned.";
    case Status::not_carried:
      return "Nothing carries the force that presses an obstacle: it moves away for ever, alone or with the "
             "structure; turn its direction round, place the obstacle where it meets the structure, or support that.";
    case Status::linear_solver_stalled:
      return "The linear systems are too ill-conditioned for double precision; use a thicker shell, a coarser mesh or "
             "higher degree.";
    case Status::not_finite:
      return "Numbers overflowed or are no numbers; look for loads, moduli or prescribed values beyond all measure.";
    case Status::inaccurate:
      return "The contact problem was solved, but the certificate misses a limit: rounding or the mesh spoils the "
             "result; use a thicker shell, a coarser mesh of higher degree, or a finer one where contact was missed.";
    case Status::gap_not_met:
      return "The gaps of curved obstacles, or the segments of a bed, did not come to rest where the shell was found; "
             "check E, the loads and their units, use a smaller load or a finer mesh, or write linearised = true for "
             "the gaps of the undeformed shell (not "
             "with the table of a bed).";
    case Status::no_equilibrium:
      return "With finite rotations no equilibrium was found near the state from which the steps started: loads, "
             "supports or obstacles move the structure too far at once, also in small parts, or it can carry no more; "
             "use smaller loads, follow a displacement by `control`, or let obstacles press in place of loads.";
    case Status::unstable:
      return "An equilibrium was found, but it is not stable: some motion lowers the energy, and the structure would "
             "snap away from it; use a smaller load, or let obstacles press it instead of loads.";
    case Status::accuracy_not_reached:
      return "The contact problem was solved, but not as accurately as was asked for: the best mesh that the limits of "
             "unknowns and time allow is reported; allow more, or ask for less.";
    case Status::interrupted:
      return "The computation was interrupted; what is reported is of the last mesh that was finished.";
  }
  return "";
}

}  // namespace plastron::contact
