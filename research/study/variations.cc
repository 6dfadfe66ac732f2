#include <research/study/variations.hpp>

#include <plastron/examination/examine.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::study {

namespace {

/// Another shell under the same loads: rho e stays, so the weight does.
void scale_thickness(energy::CrossSection& section, double factor) {
  section.thickness = section.thickness.scaled(factor);
  section.density /= factor;
}

}  // namespace

problem::Problem with_thickness_scaled(problem::Problem problem, double factor) {
  scale_thickness(problem.shell.sections.common, factor);
  for (auto& [name, section] : problem.shell.sections.regions) scale_thickness(section, factor);
  return problem;
}

std::vector<Variant> thickness_variants(const problem::Problem& problem, const std::vector<double>& factors) {
  std::vector<Variant> variants;
  for (const double factor : factors)
    if (factor != 1)
      variants.push_back({fmt::format("{:g} times the thickness", factor), with_thickness_scaled(problem, factor)});
  return variants;
}

void raise(obstacle::Obstacle& plane, double height) {
  auto& body = std::get<obstacle::HalfSpace>(plane.shape);
  body.point += height * body.normal;
}

problem::Problem with_loads_scaled(problem::Problem problem, double factor) {
  problem.shell.loads.scale(factor);
  for (fem::RigidBody& body : problem.rigid_bodies) {
    body.force *= factor;
    body.moment *= factor;
  }
  return problem;
}

problem::Problem linear_and_homogeneous(problem::Problem problem) {
  problem.shell.obstacles.all.clear();
  for (auto& support : problem.shell.supports)
    for (auto& component : support.components) component.value = {};
  for (fem::RigidBody& body : problem.rigid_bodies)
    for (auto& value : body.fixed)
      if (value) value = 0;
  return problem;
}

problem::Problem on_uniform_meshes(problem::Problem problem) {
  if (!problem.accuracy) return problem;
  problem.accuracy.reset();
  if (problem.discretisation.refinements == 0)
    problem.discretisation.refinements = problem::Discretisation{}.refinements;
  return problem;
}

problem::Problem in_formulation(problem::Problem problem, element::Formulation formulation) {
  problem.shell.tangency.formulation = formulation;
  return problem;
}

std::string refusal(const problem::Problem& problem, element::Formulation formulation) {
  for (const examination::Finding& finding : examination::examine(in_formulation(problem, formulation)))
    if (finding.severity == examination::Severity::error) return finding.text;
  return "";
}

bool has_prescribed_motion(const problem::Problem& problem) {
  for (const fem::RigidBody& body : problem.rigid_bodies)
    if (std::ranges::any_of(body.fixed, [](const auto& value) { return value.value_or(0) != 0; })) return true;
  return std::ranges::any_of(problem.shell.supports, [](const assembly::Support& support) {
    return std::ranges::any_of(support.components, [](const assembly::PrescribedComponent& c) {
      return !c.value.is_constant() || c.value(0, 0) != 0;
    });
  });
}

}  // namespace plastron::study
