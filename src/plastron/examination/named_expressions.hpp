// The expressions of loads and supports with the words a message names them by.
#pragma once
#include <plastron/computation/problem.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace plastron::examination {

struct NamedExpression {
  std::string name{};  ///< "the z component of a load's force, "1/x","
  geometry::Expression f{};
  std::string boundary{};                  ///< where it acts; empty: in the domain
  std::vector<std::string> regions{};      ///< of the domain; empty: in all of it
  std::optional<Eigen::Vector2d> point{};  ///< where alone it acts

  /// Whether it acts inside of the cells of a region.
  bool acts_in(const std::string& region) const {
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }
};

/// Those that are not constant or not finite; so are `load_expressions`.
std::vector<NamedExpression> support_expressions(const computation::Problem& problem);
std::vector<NamedExpression> load_expressions(const computation::Problem& problem);

/// An expression for a message: in quotes, cut if it is long.
std::string quoted(const geometry::Expression& f);

}  // namespace plastron::examination
