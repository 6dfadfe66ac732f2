#include <plastron/config/geometry_schema.hpp>
#include <plastron/config/obstacle_schema.hpp>

namespace plastron::config {

namespace {

Key point_key(const std::string& name, const std::string& meaning) {
  return {.name = name, .kind = Kind::vector, .unit = "m", .fallback = "[0, 0, 0]", .meaning = meaning};
}

Key direction_key(const std::string& name, const std::string& meaning) {
  return {.name = name, .kind = Kind::vector, .fallback = "[0, 0, 1]", .meaning = meaning + "; of any length but 0"};
}

Key length_key(const std::string& name, const std::string& meaning) {
  return {.name = name, .unit = "m", .range = positive(), .meaning = meaning};
}

Key radius_key(const std::string& name, const std::string& meaning, const std::string& example) {
  return {.name = name, .unit = "m", .required = true, .range = positive(), .meaning = meaning, .example = example};
}

Key fillet_key(const std::string& meaning) {
  return {.name = "fillet", .unit = "m", .fallback = "0", .range = {.low = 0}, .meaning = meaning};
}

Key inside_key(const std::string& body) {
  return {.name = "inside",
          .kind = Kind::boolean,
          .fallback = "false",
          .meaning = "true: the shell is inside, and all of space but the " + body + " is the obstacle"};
}

Section obstacle_section() {
  return {
      "obstacle",
      "[[obstacle]]",
      "A rigid body the shell cannot enter: exactly one of the shapes half_space to surface. There may be several: "
      "floor "
      "and wall, floor and ceiling.",
      {{.name = "name",
        .kind = Kind::name,
        .meaning = "a name no other obstacle has, for results and messages; obstacle-1, obstacle-2, ... if not given"},
       {.name = "half_space", .kind = Kind::table, .meaning = "all on one side of a plane"},
       {.name = "ball", .kind = Kind::table, .meaning = "a ball, or a bowl"},
       {.name = "cylinder", .kind = Kind::table, .meaning = "a roller, a bar or a tube"},
       {.name = "box", .kind = Kind::table, .meaning = "a box"},
       {.name = "torus", .kind = Kind::table, .meaning = "a ring"},
       {.name = "cone", .kind = Kind::table, .meaning = "a cone"},
       {.name = "height_field",
        .kind = Kind::table,
        .meaning =
            "all below z = h(X, Y); also written height_field = \"0.02*cos(X)\". rotate and translate give its frame",
        .shorthand = Kind::space_formula},
       {.name = "distance",
        .kind = Kind::space_formula,
        .meaning =
            "all points where the expression is not positive; its size elsewhere does not count, for the distance to "
            "its zero set is found. It must change its sign there; its gradient must not be zero there nor where the "
            "shell is. A kink, as of abs(Z) - 0.1 at Z = 0, does no harm off the zero set and the shell"},
       {.name = "surface",
        .kind = Kind::text,
        .meaning =
            "a file .stl, .obj or .ply of at most 256 MB and two million triangles, its path relative to the "
            "case file: the closed surface of a body, turned outward, that does not cut itself. Corners at open sides "
            "are joined where they are nearer to each other than a millionth of the surface's diagonal and a hundredth "
            "of its median side"},
       {.name = "rotate", .kind = Kind::table, .meaning = "turns the shape before anything else"},
       {.name = "translate",
        .kind = Kind::vector,
        .unit = "m",
        .fallback = "[0, 0, 0]",
        .meaning = "shifts the shape, after rotate"},
       {.name = "force",
        .kind = Kind::vector,
        .unit = "N",
        .fallback = "[0, 0, 0]",
        .meaning = "presses the obstacle along this direction, across it and against turning it is held; how far it "
                   "comes is found. [0, 0, 0]: the obstacle is held"},
       {.name = "face",
        .kind = Kind::word,
        .fallback = "\"auto\"",
        .words = {{"auto"}, {"lower"}, {"upper"}, {"both"}},
        .meaning = "the face of the shell that may touch: lower at -e/2, upper at +e/2 along a3, auto: point by point "
                   "the one that "
                   "looks at the obstacle; both: as two obstacles, the results of each face apart"}},
      {"half_space", "ball", "cylinder", "box", "torus", "cone", "height_field", "distance", "surface"}};
}

std::vector<Section> round_sections() {
  return {{"obstacle.ball",
           "ball",
           "The points within `radius` of `centre`.",
           {point_key("centre", "its centre"), radius_key("radius", "its radius", "0.1"), inside_key("ball")}},
          {"obstacle.cylinder",
           "cylinder",
           "A circular cylinder; infinite without length, with it plane caps end it.",
           {point_key("point", "a point of the axis, the middle of the cylinder if it has a length"),
            direction_key("axis", "direction of the axis"), radius_key("radius", "its radius", "0.1"),
            length_key("length", "distance of the caps"), inside_key("cylinder"),
            fillet_key("radius of the rounded edges of the caps, at most radius and length / 2; wants a length")}},
          {"obstacle.torus",
           "torus",
           "The points within `tube_radius` of a circle.",
           {point_key("centre", "centre of the circle"), direction_key("axis", "across the plane of the circle"),
            radius_key("radius", "radius of the circle, greater than tube_radius", "0.1"),
            radius_key("tube_radius", "radius of the ring's cross-section", "0.01")}},
          {"obstacle.cone",
           "cone",
           "A circular cone; infinite without height, with it a plane base ends it. Without fillet its tip is sharp: "
           "on the axis inside of it no direction is that of the nearest side, and any is taken.",
           {point_key("apex", "its tip, before rounding"),
            direction_key("axis", "direction of the axis, from the tip into the body"),
            {.name = "half_angle",
             .unit = "rad",
             .required = true,
             .range = {.low = 1e-3, .high = 1.57},
             .meaning = "angle between axis and side",
             .example = "\"pi/6\""},
            length_key("height", "distance of tip and base, before rounding"),
            fillet_key("radius of the rounding of tip and base, less than that of the largest ball inside")}}};
}

std::vector<Section> plane_sections() {
  return {{"obstacle.half_space",
           "half_space",
           "The points X with (X - point) . normal <= 0.",
           {point_key("point", "a point of the plane"), direction_key("normal", "towards the free side")}},
          {"obstacle.box",
           "box",
           "A box.",
           {point_key("centre", "its centre"),
            {.name = "size",
             .kind = Kind::vector,
             .unit = "m",
             .required = true,
             .range = positive(),
             .meaning = "lengths of its sides",
             .example = "[1, 1, 0.1]"},
            {.name = "axes",
             .kind = Kind::vectors,
             .fallback = "[[1, 0, 0], [0, 1, 0]]",
             .meaning = "directions of its first and its second side, perpendicular; of any length but 0"},
            fillet_key("radius of its rounded edges and corners, at most half of the shortest side")}}};
}

Section height_field_section() {
  return {
      "obstacle.height_field",
      "height_field",
      "Exactly one of these. What counts is the distance to the surface, not the height above it.",
      {{.name = "expression", .kind = Kind::space_formula, .unit = "m", .meaning = "the height h(X, Y); no Z"},
       {.name = "file",
        .kind = Kind::text,
        .meaning =
            "an ESRI ASCII grid (ncols, nrows, xllcenter or xllcorner, yllcenter or yllcorner, cellsize, then the "
            "heights, that of the greatest Y first) of at most four million heights, its path relative to "
            "the case file; a bicubic spline goes through them. It must reach beyond the shell by as much as the two "
            "are apart, and have no holes (NODATA_value)"}},
      {"expression", "file"}};
}

}  // namespace

Section rotate_section(const std::string& path) {
  return {path,
          "rotate",
          "A turn by the right hand about a line.",
          {direction_key("axis", "direction of the line"),
           {.name = "angle",
            .unit = "rad",
            .required = true,
            .range = {.low = -1e3, .high = 1e3},
            .meaning = "the angle",
            .example = "\"pi/2\""},
           point_key("about", "a point of the line")}};
}

std::vector<Section> obstacle_sections() {
  std::vector<Section> all{obstacle_section()};
  for (auto& some : {plane_sections(), round_sections()}) all.insert(all.end(), some.begin(), some.end());
  all.push_back(height_field_section());
  all.push_back(rotate_section("obstacle.rotate"));
  return all;
}

}  // namespace plastron::config
