// Checks that phi and a_3 agree where cells meet; second derivatives may jump (phi in W^{2,inf}, model.md section 1).
#include <plastron/examination/checks.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/ranges.h>

namespace plastron::examination {

namespace {

using Eigen::Vector3d;

/// Position and normal at a node from the first cell that contains it.
struct Seen {
  bool is = false;
  Vector3d phi, a3;
};

bool agree(const Seen& first, const geometry::Frame& frame, double x, double y, Examined& examined) {
  constexpr double tolerance = 1e-6;
  const double apart = (first.phi - frame.phi).norm(), turned = (first.a3 - frame.a3).norm();
  if (apart > tolerance * examined.size) {
    examined.add(Severity::error,
                 "the charts of two regions do not meet at {}: they are {:.3g} m apart; "
                 "the mid-surface must be continuous",
                 examined.place({x, y}), apart);
    return false;
  }
  if (turned <= tolerance) return true;
  examined.add(Severity::error,
               "the mid-surface has a kink at {}: the normals of both sides differ by {:.3g} degrees; "
               "curvature may jump there, the normal may not: round the fold off, or let regions meet with one tangent "
               "plane",
               examined.place({x, y}), degrees_between(turned));
  return false;
}

}  // namespace

void check_normals(Examined& examined) {
  if (examined.surface->has_directors()) return;
  const fem::Space& space = *examined.space;
  // Slightly inside the cell: on a fold itself, the normal of a chart with abs is between the normals of both sides.
  std::vector<Eigen::Vector2d> xi = examined.tables.nodes;
  for (Eigen::Vector2d& point : xi) point += 1e-9 * (mesh::centre(space.shape()) - point);
  std::vector<Seen> seen(static_cast<std::size_t>(space.layout->owned));
  std::vector<geometry::Frame> frames(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  for (std::size_t c = 0; c < space.cells.size(); ++c) {
    examined.surface->frames(space.cells[c], xi, frames, false);
    examined.surface->positions(space.cells[c], examined.tables.nodes, x, y);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      Seen& first = seen[static_cast<std::size_t>(space.nodes(c)[i])];
      if (!first.is)
        first = {true, frames[i].phi, frames[i].a3};
      else if (!agree(first, frames[i], x[i], y[i], examined))
        return;
    }
  }
  if (space.coarse->regions.size() > 1)
    examined.add(Severity::note, "regions {} meet with one normal", fmt::join(space.coarse->regions, ", "));
}

}  // namespace plastron::examination
