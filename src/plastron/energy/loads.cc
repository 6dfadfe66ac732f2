#include <plastron/energy/loads.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace plastron::energy {

namespace {

/// Calls visit(f, name, place) for each expression of constant or changeable loads.
template <class AnyLoads, class AnyVisit>
void visit_expressions(AnyLoads& loads, const AnyVisit& visit) {
  const auto visit_components = [&](auto& vector, const std::string& name, const LoadPlace& place) {
    for (std::size_t k = 0; k < 3; ++k)
      visit(vector[k], std::string("the ") + "xyz"[k] + " component of " + name, place);
  };
  for (auto& load : loads.on_areas) {
    const LoadPlace place{.regions = load.regions};
    visit_components(load.force, "a load's force", place);
    visit(load.pressure, "a load's pressure", place);
    visit_components(load.couple, "a load's couple", place);
  }
  for (auto& load : loads.on_edges) {
    const LoadPlace place{.boundary = load.boundary};
    visit_components(load.force, "a load's force", place);
    visit_components(load.couple, "a load's couple", place);
  }
}

void scale_function(VectorFunction& f, double factor) {
  if (f) f = [f, factor](double x, double y) -> Eigen::Vector3d { return factor * f(x, y); };
}

}  // namespace

geometry::Expression Spot::inside() const {
  return geometry::Expression::made(fmt::format("(X - ({:.17g}))^2 + (Y - ({:.17g}))^2 + (Z - ({:.17g}))^2 < {:.17g}",
                                                point[0], point[1], point[2], radius * radius),
                                    {});
}

Loads TotalForce::spread(const VectorExpression& density) const {
  const geometry::Expression place = spot ? spot->inside() : where;
  Loads loads;
  for (const std::string& boundary : boundaries)
    loads.on_edges.push_back({.boundary = boundary, .force = density, .where = place});
  if (boundaries.empty()) loads.on_areas.push_back({.force = density, .regions = regions, .where = place});
  return loads;
}

void Loads::for_each_expression(const Visit& visit) const {
  visit_expressions(*this, visit);
  const std::string name = "the place of a load";
  for (const AreaLoad& load : on_areas) visit(load.where, name, {.regions = load.regions});
  for (const EdgeLoad& load : on_edges) visit(load.where, name, {.boundary = load.boundary});
  for (const TotalForce& load : totals)
    visit(load.where, name,
          {.boundary = load.boundaries.empty() ? "" : load.boundaries.front(), .regions = load.regions});
}

std::vector<std::string> Loads::region_names() const {
  std::vector<std::string> names;
  const auto add = [&](const auto& load) { names.insert(names.end(), load.regions.begin(), load.regions.end()); };
  std::ranges::for_each(on_areas, add);
  std::ranges::for_each(totals, add);
  return names;
}

std::vector<std::string> Loads::boundary_names() const {
  std::vector<std::string> names;
  for (const EdgeLoad& load : on_edges) names.push_back(load.boundary);
  for (const TotalForce& load : totals) names.insert(names.end(), load.boundaries.begin(), load.boundaries.end());
  return names;
}

Loads Loads::of(int factor) const {
  Loads own{.gravity_factor = factor};
  const auto is_own = [&](const auto& load) { return load.factor == factor; };
  std::ranges::copy_if(on_areas, std::back_inserter(own.on_areas), is_own);
  std::ranges::copy_if(on_edges, std::back_inserter(own.on_edges), is_own);
  std::ranges::copy_if(totals, std::back_inserter(own.totals), is_own);
  if (gravity_factor == factor) own.gravity = gravity;
  return own;
}

void Loads::scale(double factor) {
  visit_expressions(*this,
                    [&](geometry::Expression& f, const std::string&, const LoadPlace&) { f = f.scaled(factor); });
  for (AreaLoad& load : on_areas) {
    scale_function(load.force_function, factor);
    scale_function(load.couple_function, factor);
  }
  for (TotalForce& load : totals) {
    load.force *= factor;
    load.moment *= factor;
  }
  gravity *= factor;
}

}  // namespace plastron::energy
