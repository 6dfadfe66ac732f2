#include <plastron/config/obstacle_shapes.hpp>
#include <plastron/config/printable.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>

namespace plastron::config {

namespace {

using obstacle::Shape;
using MaybeShape = std::optional<Shape>;

/// Returns true if the key is absent or a number from 0 to `most`; `limit` describes the limit.
bool check_fillet(const Table& table, double fillet, double most, const std::string& limit) {
  if (fillet <= most) return true;
  table.report("fillet", fmt::format("fillet is {}, more than the shape can be rounded", fillet),
               fmt::format("0 <= fillet <= {:.6g}, {}", most, limit));
  return false;
}

/// Returns false if the file gives the key, but it could not be read.
template <class Value>
bool is_read_or_absent(const Table& table, const std::string& name, const std::optional<Value>& value) {
  return value || !table.has(name);
}

MaybeShape read_half_space(Table& table) {
  const auto point = table.vector("point"), normal = read_direction(table, "normal");
  return point && normal ? MaybeShape(obstacle::HalfSpace{*point, *normal}) : std::nullopt;
}

MaybeShape read_ball(Table& table) {
  const auto centre = table.vector("centre");
  const auto radius = table.number("radius");
  const auto inside = table.boolean("inside");
  return centre && radius && inside ? MaybeShape(obstacle::Ball{*centre, *radius, *inside}) : std::nullopt;
}

MaybeShape read_cylinder(Table& table) {
  const auto point = table.vector("point"), axis = read_direction(table, "axis");
  const auto radius = table.number("radius"), length = table.number("length"), fillet = table.number("fillet");
  const auto inside = table.boolean("inside");
  if (!point || !axis || !radius || !is_read_or_absent(table, "length", length) || !fillet || !inside) return {};
  obstacle::Cylinder c{.point = *point, .axis = *axis, .radius = *radius, .inside = *inside, .fillet = *fillet};
  if (*fillet > 0 && !length) {
    table.report("fillet", "fillet rounds the caps, but a cylinder without length has none", "",
                 "leave the key out or add length = ...");
    return {};
  }
  if (!length) return c;
  c.length = *length;
  const bool fits = check_fillet(table, *fillet, std::min(*radius, *length / 2), "the lesser of radius and length / 2");
  return fits ? MaybeShape(c) : std::nullopt;
}

/// Returns the columns of a box's axes from its first two.
std::optional<Eigen::Matrix3d> read_axes(Table& table) {
  const auto axes = table.vectors("axes");
  if (!axes) return {};
  constexpr double most_cosine = 1e-6;
  const auto refuse = [&](const std::string& what) {
    table.report("axes", what, "two perpendicular vectors", "for example axes = [[1, 1, 0], [-1, 1, 0]]");
    return std::nullopt;
  };
  if (axes->size() != 2) return refuse(fmt::format("axes has {} vectors", axes->size()));
  const double first = (*axes)[0].stableNorm(), second = (*axes)[1].stableNorm();
  if (!(first > 0 && second > 0)) return refuse("axes has a zero vector");
  const Eigen::Vector3d a = (*axes)[0] / first, b = (*axes)[1] / second;
  if (std::abs(a.dot(b)) > most_cosine) return refuse("the two axes are not perpendicular");
  const Eigen::Vector3d across = (b - a.dot(b) * a).normalized();
  Eigen::Matrix3d all;
  all << a, across, a.cross(across);
  return all;
}

MaybeShape read_box(Table& table) {
  const auto centre = table.vector("centre"), size = table.vector("size");
  const auto axes = read_axes(table);
  const auto fillet = table.number("fillet");
  if (!centre || !size || !axes || !fillet) return {};
  if (!check_fillet(table, *fillet, size->minCoeff() / 2, "half of the shortest side")) return {};
  return obstacle::Box{*centre, *size, *axes, *fillet};
}

MaybeShape read_torus(Table& table) {
  const auto centre = table.vector("centre"), axis = read_direction(table, "axis");
  const auto radius = table.number("radius"), tube_radius = table.number("tube_radius");
  if (!centre || !axis || !radius || !tube_radius) return {};
  if (*tube_radius < *radius) return obstacle::Torus{*centre, *axis, *radius, *tube_radius};
  table.report(
      "tube_radius",
      fmt::format("the ring has no hole: tube_radius = {} is not less than radius = {}", *tube_radius, *radius),
      "0 < tube_radius < radius");
  return {};
}

MaybeShape read_cone(Table& table) {
  const auto apex = table.vector("apex"), axis = read_direction(table, "axis");
  const auto half_angle = table.number("half_angle"), height = table.number("height"), fillet = table.number("fillet");
  if (!apex || !axis || !half_angle || !is_read_or_absent(table, "height", height) || !fillet) return {};
  obstacle::Cone c{.apex = *apex, .axis = *axis, .half_angle = *half_angle, .fillet = *fillet};
  if (height) c.height = *height;
  const double share = 0.999;  // part of the ball that would remove the whole cone
  const bool fits = check_fillet(table, *fillet, share * c.largest_fillet(), "0.999 of the largest ball in the cone");
  return fits ? MaybeShape(c) : std::nullopt;
}

/// Returns the file that a key names, relative to the case file; reports mistakes in the path.
std::optional<std::string> read_path(Table& table, const std::string& name) {
  const auto path = table.text(name);
  if (!path) return {};
  if (path->empty() || has_control_characters(*path)) {
    table.report(name, path->empty() ? fmt::format("the path of {} is empty", name)
                                     : fmt::format("the path of {} has a control character", name));
    return {};
  }
  return table.reading().file(*path).string();
}

/// Returns the result of `make`. If that throws an ObstacleError, it is reported at the key.
MaybeShape made(const Table& table, const std::string& name, const std::string& allowed, const auto& make) {
  try {
    return Shape(make());
  } catch (const obstacle::ObstacleError& error) {
    table.report(name, printable(error.what()), allowed);
    return {};
  }
}

MaybeShape read_surface(Table& obstacle) {
  const auto path = read_path(obstacle, "surface");
  if (!path) return {};
  return made(obstacle, "surface", "a file .stl, .obj or .ply with the closed surface of a body, turned outward",
              [&] { return obstacle::TriangleSurface(obstacle::read_triangle_mesh(*path), *path); });
}

/// Returns the function of a key, noted as effective.
std::shared_ptr<const geometry::SpaceFunction> read_function(Table& table, const std::string& name) {
  const toml::value value = table.value(name).value();
  auto function = read_space_function(table.reading(), Item{value, name});
  if (function) table.effective[name] = function->text();
  return function;
}

MaybeShape read_distance(Table& obstacle) {
  const auto function = read_function(obstacle, "distance");
  if (!function) return {};
  return made(obstacle, "distance", "an expression of X, Y, Z, for example \"sqrt(X^2 + Y^2 + Z^2) - 1\"",
              [&] { return obstacle::DistanceField(function); });
}

MaybeShape read_height(Table& table, const std::string& name) {
  const auto function = read_function(table, name);
  if (!function) return {};
  return made(table, name, "an expression of X and Y, for example \"0.02*cos(X)\"",
              [&] { return obstacle::HeightField(function); });
}

/// Reads height_field = "expression" or { expression = ... } or { file = ... }.
MaybeShape read_height_field(Table& obstacle) {
  const std::string key = "height_field";
  if (!obstacle.value(key)->is_table()) return read_height(obstacle, key);
  auto table = obstacle.table(key);
  const bool has_file = table->has("file");
  MaybeShape shape;
  if (has_file == table->has("expression"))
    obstacle.report(key, has_file ? "height_field has both expression and file" : "height_field names no heights",
                    "expression or file", "for example height_field = \"0.02*cos(X)\"");
  else if (!has_file)
    shape = read_height(*table, "expression");
  else if (const auto path = read_path(*table, "file"))
    shape = made(*table, "file", "an ESRI ASCII grid", [&] {
      return obstacle::HeightField(std::make_shared<const obstacle::Raster>(obstacle::read_raster(*path)));
    });
  obstacle.effective[key] = table->effective;
  return shape;
}

struct ShapeReader {
  std::string key;
  std::function<MaybeShape(Table&)> read;  ///< reads the [[obstacle]]
};

/// Returns the reader of a shape that is a table of its own keys.
ShapeReader in_table(const std::string& key, MaybeShape (*read)(Table&)) {
  return {key, [=](Table& obstacle) -> MaybeShape {
            auto table = obstacle.table(key);
            if (!table) return {};
            MaybeShape shape = read(*table);
            obstacle.effective[key] = table->effective;
            return shape;
          }};
}

const std::vector<ShapeReader>& shape_readers() {
  static const std::vector<ShapeReader> all{in_table("half_space", read_half_space),
                                            in_table("ball", read_ball),
                                            in_table("cylinder", read_cylinder),
                                            in_table("box", read_box),
                                            in_table("torus", read_torus),
                                            in_table("cone", read_cone),
                                            {"height_field", read_height_field},
                                            {"distance", read_distance},
                                            {"surface", read_surface}};
  return all;
}

}  // namespace

std::optional<Eigen::Vector3d> read_direction(Table& table, const std::string& name) {
  const auto vector = table.vector(name);
  if (!vector) return {};
  if (const double length = vector->stableNorm(); length > 0) return *vector / length;
  table.report(name, fmt::format("the {} is the zero vector", name), "",
               name == "normal" ? "give the direction of the free side, for example [0, 0, 1]"
                                : "give a direction, for example [0, 0, 1]");
  return {};
}

std::optional<obstacle::Motion> read_motion(Table& table) {
  const auto shift = table.vector("translate");
  if (!table.has("rotate")) return shift ? std::optional(obstacle::Motion{.translation = *shift}) : std::nullopt;
  auto rotate = table.table("rotate");
  if (!rotate) return {};
  const auto axis = read_direction(*rotate, "axis"), about = rotate->vector("about");
  const auto angle = rotate->number("angle");
  table.effective["rotate"] = rotate->effective;
  if (!shift || !axis || !about || !angle) return {};
  return obstacle::Motion{.axis = *axis, .angle = *angle, .about = *about, .translation = *shift};
}

MaybeShape read_shape(Table& obstacle) {
  std::vector<std::string> known;
  std::vector<const ShapeReader*> given;
  for (const ShapeReader& reader : shape_readers()) {
    known.push_back(reader.key);
    if (obstacle.has(reader.key)) given.push_back(&reader);
  }
  Reading& reading = obstacle.reading();
  if (given.empty()) {
    reading.report(obstacle.place(), "[[obstacle]] names no shape", joined(known),
                   "for example half_space = { point = [0, 0, 0], normal = [0, 0, 1] }");
    return {};
  }
  if (given.size() > 1) {
    reading.report(obstacle.key_place(given[1]->key),
                   fmt::format("[[obstacle]] has both {} and {}", given[0]->key, given[1]->key),
                   fmt::format("one of {}", joined(known)), "write an [[obstacle]] for each");
    return {};
  }
  return given[0]->read(obstacle);
}

}  // namespace plastron::config
