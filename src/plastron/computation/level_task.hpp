// How a level is to be solved.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/estimation/functionals.hpp>
#include <plastron/problem/problem.hpp>

#include <optional>
#include <vector>

namespace plastron::computation {

struct LevelTask {
  int number = 0;
  contact::Settings settings{};
  problem::Linearisation linearisation{};
  bool admissible = false;                ///< see Problem
  bool leaves_unstable = false;           ///< an equilibrium that is not stable is left along its softest motion
  std::optional<algebra::Vector> zone{};  ///< expected contact zone (contact_forecast.hpp); empty at first
  /// Goals whose errors are estimated, together with the solution's error.
  std::optional<std::vector<estimation::Goal>> goals{};
  bool judges_buckling = false;  ///< in the linear model: membrane forces over the buckling load, without goals, too
  std::vector<estimation::Goal> valued{};  ///< goals of which only values are computed
  Seconds seconds{};                       ///< time spent on the mesh and on `discrete`
};

}  // namespace plastron::computation
