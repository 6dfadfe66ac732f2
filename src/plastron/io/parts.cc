#include <plastron/io/fields.hpp>
#include <plastron/io/parts.hpp>

#include <algorithm>

namespace plastron::io {

namespace {

template <class Record>
Part part(std::string place, std::string_view meaning, std::span<const Quantity<Record>> quantities) {
  Part part{std::move(place), meaning, {}};
  for (const auto& q : quantities) part.entries.push_back({q.path, q.unit, q.meaning, q.form});
  return part;
}

Form form_of(const Field& field) {
  return field.components == 1 ? Form::number : field.components == 2 ? Form::pair : Form::triple;
}

Part probes(std::string place, std::string_view meaning) {
  Part part{std::move(place), meaning, {}};
  for (const Field& f : fields())
    part.entries.push_back({f.key, f.unit, f.meaning, form_of(f), f.presence != Presence::always});
  return part;
}

}  // namespace

const std::vector<Part>& parts() {
  static const std::vector<Part> all{
      part("", "the result as a whole, that of the last step where there are steps", result_quantities()),
      part("singular_places/*/", "where stresses have no limit as the mesh is refined", singular_place_quantities()),
      part("supports/*/", "what each boundary carries that supports hold", support_quantities()),
      part("corner_supports/*/", "what supports carry at corners where edges meet", corner_support_quantities()),
      part("point_supports/*/", "what each point carries that supports hold", point_support_quantities()),
      part("rigid_bodies/*/", "what each rigid body does", rigid_body_quantities()),
      part("contact/", "contact with all obstacles; null without obstacle", contact_quantities()),
      part("contact/admissible/", "what lifted bounds cost; null unless contact.admissible", admissible_quantities()),
      part("obstacles/*/", "contact with each obstacle", obstacle_quantities()),
      part("history/*/", "the end of each part of the steps; empty without steps", history_quantities()),
      part("history/*/obstacles/*/", "contact with each obstacle then", obstacle_quantities()),
      part("obstacles/*/zones/*/", "each connected contact zone", zone_quantities()),
      probes("probes/*/", "fields at each [[probe]], by its name"),
      probes("history/*/probes/*/", "fields at each [[probe]] then"),
      part("estimates/",
           "how far the last solution is thought to be from the exact one; null where that was not estimated",
           estimate_quantities()),
      part("estimates/goals/*/", "the error of each number that was asked for", goal_quantities()),
      part("certificate/", "how well the result satisfies the equations", certificate_quantities()),
      part("levels/*/", "each mesh of the sequence", level_quantities()),
      part("levels/*/history/*/", "each active-set iteration on it", iteration_quantities())};
  return all;
}

std::string dotted(std::string_view place, std::string_view path) {
  std::string result = std::string(place).append(path);
  std::ranges::replace(result, '/', '.');
  for (std::size_t at = 0; (at = result.find(".*")) != std::string::npos;)
    result.replace(at, 2, result.substr(0, at).ends_with("probes") ? ".NAME" : "[]");
  return result;
}

}  // namespace plastron::io
