// Reads [[rigid_body]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

const std::vector<std::string>& body_components() {
  static const std::vector<std::string> all{"u.x", "u.y", "u.z", "theta.x", "theta.y", "theta.z"};
  return all;
}

std::size_t body_component(const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(body_components(), name) - body_components().begin());
}

void read_body_fix(Table& table, fem::RigidBody& body) {
  const auto words = table.texts("fix");
  if (!words) return;
  for (std::size_t i = 0; i < words->size(); ++i)
    for (const char* axis : {".x", ".y", ".z"}) {
      const std::string& word = (*words)[i];
      const bool is_vector = word == "u" || word == "theta";
      if (!is_vector && axis[1] != 'x') break;
      auto& value = body.fixed[body_component(is_vector ? word + axis : word)];
      if (value) {
        const toml::value list = table.value("fix").value();
        table.reading().report(list.as_array()[i], fmt::format("{} is fixed twice", is_vector ? word + axis : word));
        break;
      }
      value = 0;
    }
}

void read_body_values(Table& table, fem::RigidBody& body) {
  const toml::value given = table.value("values").value();
  Reading& reading = table.reading();
  if (!given.is_table()) return report_kind(reading, Item{given, "values"}, Kind::table);
  std::vector<std::string> allowed;
  for (std::size_t k = 0; k < 6; ++k)
    if (body.fixed[k]) allowed.push_back(body_components()[k]);
  for (const auto& [name, value] : named_values(reading, given, {"u", "theta"})) {
    if (std::ranges::find(allowed, name) == allowed.end())
      reading.report(value, fmt::format("values gives {}, which fix does not name", geometry::shortened(name)),
                     joined(allowed), did_you_mean(name, allowed));
    else if (const auto number = read_number(reading, component_item(value, name)))
      body.fixed[body_component(name)] = *number;
  }
}

void check_body_name(const Table& table, const std::vector<fem::RigidBody>& before, const std::string& name) {
  if (std::ranges::find(before, name, &fem::RigidBody::name) != before.end())
    table.report("name", fmt::format("there is a rigid body \"{}\" already", name), "a name that no other body has");
}

}  // namespace

std::vector<Section> rigid_body_sections() {
  using fem::RigidBody;
  return {
      {"rigid_body",
       "[[rigid_body]]",
       "A rigid body that carries edges of the shell, such as an end plate or a clamp. Their nodes move as u = d + "
       "theta x (phi - reference), r = theta x a3, with six unknowns for all nodes. Obstacles do not stop these nodes; "
       "the depth of the shell in an obstacle there is measured and reported.",
       {key("name", &RigidBody::name, {.required = true, .example = "\"end plate\""},
            "a name that no other body has; step.factors multiply its force, moment and values"),
        key("boundary", &RigidBody::boundaries, read_boundaries,
            {.kind = Kind::name_or_names, .required = true, .example = "\"right\""},
            "one or several boundaries of the domain; two bodies must not share a node"),
        key("reference", &RigidBody::reference, {.unit = "m", .required = true, .example = "[1, 0, 0]"},
            "the point with displacement d, anywhere in space; force and moment act there"),
        key("rotations", &RigidBody::turns_normals, {.fallback = "true"},
            "true: u and r follow the body; false: a hinge, where only u follows it"),
        key("fix", Kind::names,
            {.fallback = "[]", .words = {"u", "theta", "u.x", "u.y", "u.z", "theta.x", "theta.y", "theta.z"}},
            "the prescribed components of d (written u) and theta; u and theta stand for all three components. A "
            "support of these edges must not fix a component that is not fixed here"),
        key("values", Kind::free_table, {.unit = "m, rad", .fallback = "{}"},
            "values of fixed components, each a number: { u.z = -0.01 } or { theta = [0, 0, 0.1] }; 0 if not given"),
        key("force", &RigidBody::force, {.unit = "N", .fallback = "[0, 0, 0]"},
            "force on the body at the reference point"),
        key("moment", &RigidBody::moment, {.unit = "N m", .fallback = "[0, 0, 0]"},
            "moment on the body about the reference point")}}};
}

void read_rigid_bodies(Table& root, problem::Problem& problem) {
  root.in_tables("rigid_body", [&](Table& table) {
    fem::RigidBody body;
    table.fill(body);
    check_body_name(table, problem.rigid_bodies, body.name);
    body.factor = factor_of(body.name, problem);
    read_body_fix(table, body);
    read_body_values(table, body);
    auto& values = table.effective["values"] = nlohmann::json::object();
    for (std::size_t k = 0; k < 6; ++k)
      if (body.fixed[k]) values[body_components()[k]] = *body.fixed[k];
    problem.rigid_bodies.push_back(std::move(body));
  });
}

}  // namespace plastron::config
