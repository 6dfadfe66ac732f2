// The part of the table of quantities (quantities.cc) that belongs to rigid bodies.
#include <plastron/io/quantities.hpp>

namespace plastron::io {

namespace {

Json vector_json(const Eigen::Vector3d& v) { return Json::array({number(v[0]), number(v[1]), number(v[2])}); }

}  // namespace

std::span<const Quantity<solution::BodyReaction>> rigid_body_quantities() {
  using solution::BodyReaction;
  static const std::vector<Quantity<BodyReaction>> all{
      {"name", "-", "its name", [](const BodyReaction& b) { return Json(b.name); }, Form::text},
      {"reference", "m", "its reference point, where it is at first",
       [](const BodyReaction& b) { return vector_json(b.reference); }, Form::triple},
      {"displacement", "m", "d, of the reference point",
       [](const BodyReaction& b) { return vector_json(b.displacement); }, Form::triple},
      {"rotation", "rad", "theta, small", [](const BodyReaction& b) { return vector_json(b.rotation); }, Form::triple},
      {"reaction/force", "N", "what holds the body where it is fixed, along what is fixed; part of support_reaction",
       [](const BodyReaction& b) { return vector_json(b.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "its moment about the origin",
       [](const BodyReaction& b) { return vector_json(b.reaction.moment); }, Form::triple},
      {"moment_at_reference", "N m", "its moment about the reference point",
       [](const BodyReaction& b) { return vector_json(b.moment_at_reference); }, Form::triple},
      {"least_gap", "m", "the smallest gap at its nodes, which no bound holds; null without obstacle",
       [](const BodyReaction& b) { return number(b.least_gap); }},
  };
  return all;
}

}  // namespace plastron::io
