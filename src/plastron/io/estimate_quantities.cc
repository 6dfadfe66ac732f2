#include <plastron/io/quantities.hpp>

#include <cmath>

namespace plastron::io {

std::span<const Quantity<computation::Result>> estimate_quantities() {
  using computation::Result;
  static const std::vector<Quantity<Result>> all{
      {"energy_norm/squared", "J", "a(e, e) of the error e of the solution",
       [](const Result& r) { return number(r.estimates->energy_norm_squared); }},
      {"energy_norm/relative", "1", "its root over that of a(U, U)",
       [](const Result& r) {
         return number(std::sqrt(r.estimates->energy_norm_squared / (2 * r.summary.energy.total())));
       }},
      {"unjudged_cells", "1", "cells without a neighbour to judge them by: the shares of their errors are too small",
       [](const Result& r) { return Json(r.estimates->unjudged_cells); }, Form::integer},
  };
  return all;
}

std::span<const Quantity<estimation::GoalEstimate>> goal_quantities() {
  using estimation::GoalEstimate;
  static const std::vector<Quantity<GoalEstimate>> all{
      {"name", "-", "of the number whose error this is", [](const GoalEstimate& g) { return Json(g.name); },
       Form::text},
      {"unit", "-", "of the numbers here", [](const GoalEstimate& g) { return Json(g.unit); }, Form::text},
      {"value", "see unit", "what was computed", [](const GoalEstimate& g) { return number(g.value); }},
      {"tolerance", "1", "relative error that was asked for; null where none was",
       [](const GoalEstimate& g) { return g.tolerance ? number(*g.tolerance) : Json(nullptr); }},
      {"difference", "see unit",
       "exact value minus this: by the higher degree, or away from the edges of contact zones",
       [](const GoalEstimate& g) { return number(g.difference()); }},
      {"corrected", "see unit", "the value and the difference together",
       [](const GoalEstimate& g) { return number(g.value + g.difference()); }},
      {"at_higher_degree", "see unit",
       "what was computed on the same cells at one degree more, where that was needed to judge an accuracy; or null",
       [](const GoalEstimate& g) { return g.at_higher_degree ? number(*g.at_higher_degree) : Json(nullptr); }},
      {"contact_edge", "see unit", "what the edges of contact zones may add to the difference, of either sign",
       [](const GoalEstimate& g) { return number(g.contact_edge); }},
      {"error", "see unit", "how large the difference is thought to be, by all of these",
       [](const GoalEstimate& g) { return number(g.error()); }},
      {"has_dual", "-", "the dual problem could be solved; without, its part of the difference is missing",
       [](const GoalEstimate& g) { return Json(g.has_dual); }, Form::flag},
      {"dual_energy", "J",
       "energy of the dual solution per squared unit; where refinement lets it grow, the number has no limit",
       [](const GoalEstimate& g) { return number(g.dual_energy); }},
  };
  return all;
}

}  // namespace plastron::io
