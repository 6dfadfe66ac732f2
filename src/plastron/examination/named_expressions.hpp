// The expressions of loads and supports, with their names in messages.
#pragma once
#include <plastron/problem/problem.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace plastron::examination {

struct NamedExpression {
  std::string name{};  ///< "the z component of a load's force, "1/x","
  geometry::Expression f{};
  std::string boundary{};                  ///< boundary where it acts; empty: in the domain
  std::vector<std::string> regions{};      ///< regions of the domain; empty: in all of it
  std::optional<Eigen::Vector2d> point{};  ///< the only point where it acts

  /// Whether it acts inside the cells of a region.
  bool acts_in(const std::string& region) const {
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }
};

/// Returns the expressions of supports that are not constant or not finite. The same holds for `load_expressions`.
std::vector<NamedExpression> support_expressions(const problem::Problem& problem);
std::vector<NamedExpression> load_expressions(const problem::Problem& problem);

/// Returns an expression for a message: in quotes, shortened if it is long.
std::string quoted(const geometry::Expression& f);

}  // namespace plastron::examination
