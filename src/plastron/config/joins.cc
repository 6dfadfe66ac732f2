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
  return {{"join",
           "[[join]]",
           "Two edges that coincide in space and are joined there: a rectangle is closed to a tube, or pieces of a "
           "mesh file become one shell. Edges that meet at an angle share u and the rotation about the edge. The "
           "normals a3 of both sides must not be opposite.",
           {key("boundaries", Kind::names, {.required = true, .example = "[\"left\", \"right\"]"},
                "two boundaries of the domain that are divided into the same cells")}}};
}

void read_joins(Table& root, problem::Problem& problem) {
  root.in_tables("join", [&](Table& join) {
    const auto given = join.texts("boundaries");
    if (!given) return;
    const std::vector<std::string>& names = *given;
    if (names.size() != 2)
      join.report("boundaries", fmt::format("a join has {} boundaries", names.size()), "two");
    else if (names[0] == names[1])
      join.report("boundaries", fmt::format("\"{}\" is to be joined to itself", names[0]), "two boundaries");
    else if (is_boundary(join, names[0]) && is_boundary(join, names[1]))
      problem.joins.push_back({{names[0], names[1]}});
  });
}

}  // namespace plastron::config
