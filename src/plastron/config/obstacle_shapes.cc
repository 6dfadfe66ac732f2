// Reads the shapes of obstacles, one for each key of [[obstacle]] that names one.
#include <plastron/config/printable.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/file_error.hpp>
#include <plastron/geometry/triangle_mesh.hpp>
#include <plastron/obstacle/error.hpp>

#include <cmath>
#include <map>

namespace plastron::config {

namespace {

using obstacle::HalfSpace, obstacle::Ball, obstacle::Cylinder, obstacle::Box, obstacle::Torus, obstacle::Cone;
using obstacle::Shape;
using MaybeShape = std::optional<Shape>;

/// Returns true if the key is absent or a number from 0 to `most`; `limit` describes the limit.
bool check_fillet(const Table& table, double fillet, double most, const std::string& limit) {
  if (fillet <= most) return true;
  table.report("fillet", fmt::format("fillet is {}, more than the shape can be rounded", fillet),
               fmt::format("0 <= fillet <= {:.6g}, {}", most, limit));
  return false;
}

bool is_right(const Table& /*table*/, const auto& /*shape*/) { return true; }

bool is_right(const Table& table, const Cylinder& c) {
  const bool is_endless = !std::isfinite(c.length);
  if (!is_endless)
    return check_fillet(table, c.fillet, std::min(c.radius, c.length / 2), "the lesser of radius and length / 2");
  if (c.fillet > 0)
    table.report("fillet", "fillet rounds the caps, but a cylinder without length has none", "",
                 "leave the key out or add length = ...");
  return c.fillet <= 0;
}

bool is_right(const Table& table, const Box& b) {
  return check_fillet(table, b.fillet, b.size.minCoeff() / 2, "half of the shortest side");
}

bool is_right(const Table& table, const Torus& t) {
  if (t.tube_radius < t.radius) return true;
  table.report(
      "tube_radius",
      fmt::format("the ring has no hole: tube_radius = {} is not less than radius = {}", t.tube_radius, t.radius),
      "0 < tube_radius < radius");
  return false;
}

bool is_right(const Table& table, const Cone& c) {
  const double share = 0.999;  // part of the ball that would remove the whole cone
  return check_fillet(table, c.fillet, share * c.largest_fillet(), "0.999 of the largest ball in the cone");
}

/// Reads a shape that is a table of its own keys.
template <class Keys>
MaybeShape read_table(Table& obstacle, const std::string& name) {
  MaybeShape result;
  obstacle.in_table(name, [&](Table& table) {
    Keys shape;
    if (table.fill(shape) && is_right(table, shape)) result = shape;
  });
  return result;
}

/// Returns the columns of a box's axes from its first two.
std::optional<Eigen::Matrix3d> read_axes(Table& table, const std::string& name) {
  const auto axes = table.vectors(name);
  if (!axes) return {};
  constexpr double most_cosine = 1e-6;
  const auto refuse = [&](const std::string& what) {
    table.report(name, what, "two perpendicular vectors", "for example axes = [[1, 1, 0], [-1, 1, 0]]");
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

/// Returns the result of `make`. If that throws a FileError or an ObstacleError, it is reported at the key.
MaybeShape made(const Table& table, const std::string& name, const std::string& allowed, const auto& make) {
  try {
    return Shape(make());
  } catch (const obstacle::ObstacleError& error) {
    table.report(name, printable(error.what()), allowed);
  } catch (const geometry::FileError& error) {
    table.report(name, printable(error.what()), allowed);
  }
  return {};
}

MaybeShape read_surface(Table& obstacle, const std::string& name) {
  const auto path = read_path(obstacle, name);
  if (!path) return {};
  return made(obstacle, name, "a file .stl, .obj or .ply with the closed surface of a body, turned outward",
              [&] { return obstacle::TriangleSurface(geometry::read_triangle_mesh(*path), *path); });
}

/// Returns the function of a key, noted as effective.
std::shared_ptr<const geometry::SpaceFunction> read_function(Table& table, const std::string& name) {
  const toml::value value = table.value(name).value();
  auto function = read_space_function(table.reading(), Item{value, name});
  if (function) table.effective[name] = function->text();
  return function;
}

MaybeShape read_distance(Table& obstacle, const std::string& name) {
  const auto function = read_function(obstacle, name);
  if (!function) return {};
  return made(obstacle, name, "an expression of X, Y, Z, for example \"sqrt(X^2 + Y^2 + Z^2) - 1\"",
              [&] { return obstacle::DistanceField(function); });
}

MaybeShape read_height(Table& table, const std::string& name) {
  const auto function = read_function(table, name);
  if (!function) return {};
  return made(table, name, "an expression of X and Y, for example \"0.02*cos(X)\"",
              [&] { return obstacle::HeightField(function); });
}

/// Reads height_field = "expression" or { expression = ... } or { file = ... }.
MaybeShape read_height_field(Table& obstacle, const std::string& name) {
  if (!obstacle.value(name)->is_table()) return read_height(obstacle, name);
  MaybeShape shape;
  obstacle.in_table(name, [&](Table& table) {
    const bool has_file = table.has("file");
    if (has_file == table.has("expression"))
      obstacle.report(name, has_file ? "height_field has both expression and file" : "height_field names no heights",
                      "expression or file", "for example height_field = \"0.02*cos(X)\"");
    else if (!has_file)
      shape = read_height(table, "expression");
    else if (const auto path = read_path(table, "file"))
      shape = made(table, "file", "an ESRI ASCII grid", [&] {
        return obstacle::HeightField(std::make_shared<const obstacle::Raster>(obstacle::read_raster(*path)));
      });
  });
  return shape;
}

Key point_key(const char* name, auto member, const char* meaning) {
  return key(name, member, {.unit = "m", .fallback = "[0, 0, 0]"}, meaning);
}

Key direction_key(const char* name, auto member, const std::string& meaning) {
  return key(name, member, &Table::direction, {.kind = Kind::vector, .fallback = "[0, 0, 1]"},
             meaning + "; any length except 0");
}

Key length_key(const char* name, auto member, const char* meaning) {
  return key(name, member, {.unit = "m", .range = Range::positive()}, meaning);
}

Key radius_key(const char* name, auto member, const char* meaning, const char* example = "0.1") {
  return key(name, member, {.unit = "m", .required = true, .range = Range::positive(), .example = example}, meaning);
}

Key fillet_key(auto member, const char* meaning) {
  return key("fillet", member, {.unit = "m", .fallback = "0", .range = {.low = 0}}, meaning);
}

Key inside_key(auto member, const std::string& body) {
  return key("inside", member, {.fallback = "false"},
             "true: the shell is inside, and the obstacle is all of space except the " + body);
}

std::vector<Section> flat_shapes() {
  return {
      {"obstacle.half_space",
       "half_space",
       "The points X with (X - point) . normal <= 0.",
       {point_key("point", &HalfSpace::point, "a point of the plane"),
        direction_key("normal", &HalfSpace::normal, "direction towards the free side")}},
      {"obstacle.box",
       "box",
       "A box.",
       {point_key("centre", &Box::centre, "its centre"),
        key("size", &Box::size, {.unit = "m", .required = true, .range = Range::positive(), .example = "[1, 1, 0.1]"},
            "lengths of its sides"),
        key("axes", &Box::axes, read_axes, {.kind = Kind::vectors, .fallback = "[[1, 0, 0], [0, 1, 0]]"},
            "directions of its first and second side, perpendicular; any length except 0"),
        fillet_key(&Box::fillet, "radius of its rounded edges and corners, at most half of the shortest side")}}};
}

std::vector<Section> round_shapes() {
  return {
      {"obstacle.ball",
       "ball",
       "The points within `radius` of `centre`.",
       {point_key("centre", &Ball::centre, "its centre"), radius_key("radius", &Ball::radius, "its radius"),
        inside_key(&Ball::inside, "ball")}},
      {"obstacle.cylinder",
       "cylinder",
       "A circular cylinder. Without length it is infinite; with a length it has plane caps.",
       {point_key("point", &Cylinder::point, "a point of the axis; with a length, the middle of the cylinder"),
        direction_key("axis", &Cylinder::axis, "direction of the axis"),
        radius_key("radius", &Cylinder::radius, "its radius"),
        length_key("length", &Cylinder::length, "distance between the caps"), inside_key(&Cylinder::inside, "cylinder"),
        fillet_key(&Cylinder::fillet,
                   "radius of the rounded edges of the caps, at most radius and length / 2; needs a length")}},
      {"obstacle.torus",
       "torus",
       "The points within `tube_radius` of a circle.",
       {point_key("centre", &Torus::centre, "centre of the circle"),
        direction_key("axis", &Torus::axis, "direction normal to the plane of the circle"),
        radius_key("radius", &Torus::radius, "radius of the circle, greater than tube_radius"),
        radius_key("tube_radius", &Torus::tube_radius, "radius of the cross-section of the ring", "0.01")}},
      {"obstacle.cone",
       "cone",
       "A circular cone. Without height it is infinite; with a height it has a plane base. Without fillet its tip is "
       "sharp. On the axis inside the cone several directions to the side are equally near; one of them is used.",
       {point_key("apex", &Cone::apex, "its tip, before rounding"),
        direction_key("axis", &Cone::axis, "direction of the axis, from the tip into the body"),
        key("half_angle", &Cone::half_angle,
            {.unit = "rad", .required = true, .range = Range::between(1e-3, 1.57), .example = "\"pi/6\""},
            "angle between axis and side"),
        length_key("height", &Cone::height, "distance from tip to base, before rounding"),
        fillet_key(&Cone::fillet, "radius of the rounded tip and base, less than that of the largest ball inside")}}};
}

Section height_field_section() {
  return {"obstacle.height_field",
          "height_field",
          "Exactly one of these keys is given. The gap is the distance to the surface, not the height above it.",
          {key("expression", Kind::space_formula, {.unit = "m"}, "the height h(X, Y), without Z"),
           key("file", Kind::text, {},
               "an ESRI ASCII grid of at most four million heights; its path is relative to the case file. The file "
               "has ncols, nrows, xllcenter or xllcorner, yllcenter or yllcorner, cellsize, then the heights, "
               "beginning with the greatest Y. A bicubic spline interpolates them. The grid must extend beyond the "
               "shell by at least the distance between both, and have no holes (NODATA_value)")},
          {"expression", "file"}};
}

}  // namespace

std::vector<Section> obstacle_shape_sections() {
  std::vector<Section> all = flat_shapes();
  std::ranges::move(round_shapes(), std::back_inserter(all));
  all.push_back(height_field_section());
  return all;
}

MaybeShape read_shape(Table& obstacle) {
  static const std::map<std::string, MaybeShape (*)(Table&, const std::string&)> readers{
      {"half_space", read_table<HalfSpace>},
      {"ball", read_table<Ball>},
      {"cylinder", read_table<Cylinder>},
      {"box", read_table<Box>},
      {"torus", read_table<Torus>},
      {"cone", read_table<Cone>},
      {"height_field", read_height_field},
      {"distance", read_distance},
      {"surface", read_surface}};
  const auto name =
      obstacle.shape("half_space = { point = [0, 0, 0], normal = [0, 0, 1] }", "write an [[obstacle]] for each");
  return name ? readers.at(*name)(obstacle, *name) : std::nullopt;
}

}  // namespace plastron::config
