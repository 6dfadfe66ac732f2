#include <plastron/config/geometry_schema.hpp>

namespace plastron::config {

namespace {

Section geometry_section() {
  return {"geometry",
          "[geometry]",
          "The mid-surface is the image of a plane domain under the chart.",
          {{.name = "domain",
            .kind = Kind::table,
            .required = true,
            .meaning = "the domain of the parameters x, y",
            .example = "{ disk = { radius = 1 } }"},
           {.name = "chart",
            .kind = Kind::formulas,
            .unit = "m",
            .required = true,
            .meaning = "the point of the mid-surface, three expressions; for a domain of named regions also a table "
                       "region = [three expressions]",
            .example = "[\"x\", \"y\", \"0\"]"}}};
}

Section domain_section() {
  return {
      "geometry.domain",
      "domain",
      "Exactly one of these.",
      {{.name = "rectangle",
        .kind = Kind::table,
        .meaning = "boundaries left, right, bottom, top (x min, x max, y min, y max)"},
       {.name = "disk", .kind = Kind::table, .meaning = "boundary rim"},
       {.name = "annulus", .kind = Kind::table, .meaning = "boundaries inner, outer"},
       {.name = "polygon",
        .kind = Kind::table,
        .meaning = "boundaries edge1 (from corner 1 to corner 2), edge2, ...; also written polygon = [corners]",
        .shorthand = Kind::points},
       {.name = "mesh",
        .kind = Kind::text,
        .meaning = "a Gmsh file (.msh, format 2.2 or 4.1, ASCII) of quadrilaterals or triangles in the plane, its path "
                   "relative to the case file; physical surfaces name the regions, physical curves the boundaries: "
                   "a curve may lie inside of the domain, where the conormal n of supports points to the right of "
                   "the curve as drawn, and in several groups, which then all act on it; corners of more than one "
                   "degree are corners, so mesh curved boundaries with order 2 or more"}},
      {"rectangle", "disk", "annulus", "polygon", "mesh"}};
}

std::vector<Section> domain_shapes() {
  return {{"geometry.domain.rectangle",
           "rectangle",
           "A rectangle, possibly cut into regions side by side.",
           {{.name = "from", .kind = Kind::point, .fallback = "[0, 0]", .meaning = "corner of least x and y"},
            {.name = "to",
             .kind = Kind::point,
             .required = true,
             .meaning = "corner of greatest x and y",
             .example = "[1, 1]"},
            {.name = "cells",
             .kind = Kind::cell_counts,
             .range = {.low = 1, .high = 10000},
             .meaning = "cells of the coarsest mesh along x and y; without it they are as square as can be"},
            {.name = "breaks",
             .kind = Kind::numbers,
             .fallback = "[]",
             .meaning = "ascending x where one region ends and the next begins"},
            {.name = "regions",
             .kind = Kind::names,
             .fallback = "[]",
             .meaning = "names of the regions from left to right, one more than breaks"}}},
          {"geometry.domain.disk",
           "disk",
           "A disk.",
           {{.name = "centre", .kind = Kind::point, .fallback = "[0, 0]", .meaning = "its centre"},
            {.name = "radius", .required = true, .range = positive(), .meaning = "its radius", .example = "1"}}},
          {"geometry.domain.annulus",
           "annulus",
           "A disk with a concentric hole.",
           {{.name = "centre", .kind = Kind::point, .fallback = "[0, 0]", .meaning = "its centre"},
            {.name = "inner", .required = true, .range = positive(), .meaning = "radius of the hole", .example = "0.5"},
            {.name = "outer",
             .required = true,
             .range = positive(),
             .meaning = "outer radius, greater than inner",
             .example = "1"}}},
          {"geometry.domain.polygon",
           "polygon",
           "A polygon whose sides do not cross.",
           {{.name = "corners",
             .kind = Kind::points,
             .required = true,
             .meaning = "three to 500 corners, in either sense",
             .example = "[[0, 0], [1, 0], [0, 1]]"}}}};
}

}  // namespace

std::vector<Section> geometry_sections() {
  std::vector<Section> all{geometry_section(), domain_section()};
  for (Section& shape : domain_shapes()) all.push_back(std::move(shape));
  return all;
}

}  // namespace plastron::config
