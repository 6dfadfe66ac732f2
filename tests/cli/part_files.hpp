// CAD files for tests, drawn and written by Gmsh's interface to Open CASCADE.
#pragma once
#include <gmsh.h>

#include <array>

#include <filesystem>
#include <functional>
#include <vector>

namespace plastron::part_files {

/// Draws by `draw` in millimetres and writes a STEP file.
inline void write_step(const std::filesystem::path& path, const std::function<void()>& draw) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  draw();
  gmsh::model::occ::synchronize();
  gmsh::write(path.string());
  gmsh::finalize();
}

inline int polyline_face(const std::vector<std::array<double, 3>>& corners) {
  std::vector<int> points, lines;
  for (const auto& [x, y, z] : corners) points.push_back(gmsh::model::occ::addPoint(x, y, z));
  for (std::size_t i = 0; i < points.size(); ++i)
    lines.push_back(gmsh::model::occ::addLine(points[i], points[(i + 1) % points.size()]));
  return gmsh::model::occ::addPlaneSurface({gmsh::model::occ::addCurveLoop(lines)});
}

/// A plate of 100 x 60 with a rib of height 20 that stands on it and shares no edge.
inline void draw_rib() {
  gmsh::model::occ::addRectangle(0, 0, 0, 100, 60);
  polyline_face({{20, 30, 0}, {80, 30, 0}, {80, 30, 20}, {20, 30, 20}});
}

/// A sheet of thickness e that is bent by a right angle with the inner radius r: legs of length a, width b; a solid.
inline void draw_bent_sheet(double a, double b, double e, double r) {
  namespace occ = gmsh::model::occ;
  const double h = a - r - e;
  const int p[] = {occ::addPoint(0, 0, 0),         occ::addPoint(h, 0, 0),     occ::addPoint(h + r + e, 0, r + e),
                   occ::addPoint(h + r + e, 0, a), occ::addPoint(h + r, 0, a), occ::addPoint(h + r, 0, r + e),
                   occ::addPoint(h, 0, e),         occ::addPoint(0, 0, e),     occ::addPoint(h, 0, r + e)};
  const std::vector<int> curves{occ::addLine(p[0], p[1]), occ::addCircleArc(p[1], p[8], p[2]),
                                occ::addLine(p[2], p[3]), occ::addLine(p[3], p[4]),
                                occ::addLine(p[4], p[5]), occ::addCircleArc(p[5], p[8], p[6]),
                                occ::addLine(p[6], p[7]), occ::addLine(p[7], p[0])};
  gmsh::vectorpair made;
  occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(curves)})}}, 0, b, 0, made);
}

}  // namespace plastron::part_files
