// Reads [[join]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

bool is_boundary(const Table& join, const std::string& name) {
  const auto known = join.reading().boundaries();
  if (known.empty() || std::ranges::count(known, name) > 0) return true;
  join.report("boundaries", fmt::format("the domain has no boundary \"{}\"", name), joined(known),
              did_you_mean(name, known));
  return false;
}

}  // namespace

std::vector<Section> join_sections() {
  return {
      {"join",
       "[[join]]",
       "Two edges that coincide in space and are joined there: a rectangle is closed to a tube, or pieces of a "
       "mesh file become one shell. Edges that meet at an angle share u and the rotation about the edge; at a hinge "
       "they share u alone. The normals a3 of both sides must not be opposite.",
       {key("boundaries", Kind::names, {.required = true, .example = "[\"left\", \"right\"]"},
            "two boundaries of the domain that are divided into the same cells"),
        key("hinge", Kind::boolean, {.fallback = "false"},
            "true: a hinge, at which each edge has a rotation of its own"),
        key("stiffness", Kind::number, {.unit = "N", .range = {.low = 0}},
            "the join is a hinge with a spring along it: moment per length and radian of the change of the angle "
            "between both sides; a free hinge has none")}}};
}

void read_joins(Table& root, problem::Problem& problem) {
  root.in_tables("join", [&](Table& join) {
    const auto given = join.texts("boundaries");
    const auto hinge = join.boolean("hinge");
    const bool has_stiffness = join.has("stiffness");
    const double stiffness = has_stiffness ? join.number("stiffness").value_or(0) : 0;
    if (has_stiffness && join.has("hinge") && hinge == false)
      join.report("hinge", "a join with a stiffness is a hinge", "",
                  "leave stiffness out, or leave hinge out for a hinge with a spring");
    if (!given) return;
    const std::vector<std::string>& names = *given;
    if (names.size() != 2)
      join.report("boundaries", fmt::format("a join has {} boundaries", names.size()), "two");
    else if (names[0] == names[1])
      join.report("boundaries", fmt::format("\"{}\" is to be joined to itself", names[0]), "two boundaries");
    else if (is_boundary(join, names[0]) && is_boundary(join, names[1]))
      problem.joins.push_back({{names[0], names[1]}, hinge.value_or(false) || has_stiffness, stiffness});
  });
}

}  // namespace plastron::config
