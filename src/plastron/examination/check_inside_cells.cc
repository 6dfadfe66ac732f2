// Checks smoothness inside each cell. Elements assume that a_3 and the thickness do not jump there; the
// curvature should not jump. Loads may jump: they are integrated between their borders (element/piece_rules.hpp).
#include <plastron/examination/jumps.hpp>
#include <plastron/geometry/frame.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::examination {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using Lines = JumpSearch::Lines;

constexpr const char* mesh_line =
    "put a mesh line there: breaks of a rectangle, a polygon's edge or the edges of a mesh file";

/// Returns the shape operator as a tensor of space, which does not depend on the cell's coordinates [1/m].
Eigen::Matrix3d shape_tensor(const geometry::Frame& frame) {
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (int a = 0; a < 2; ++a) S -= frame.da3[a] * frame.a_con[a].transpose();
  return S;
}

bool check_kinks(Examined& examined, const JumpSearch& search) {
  const CellFunction surface = [&](const fem::Cell& cell, const Vector2d& xi) {
    const geometry::Frame frame = examined.surface->frame(cell, xi, false);
    Sample s(6);
    s << frame.phi / examined.size, frame.a3;
    return s;
  };
  const auto kink = search.in_cells(surface, 1e-5, Lines::forbidden);
  if (!kink) return true;
  examined.add(Severity::error,
               "the mid-surface has a kink or a jump inside of a cell near {}, of about {:.3g} degrees; "
               "curvature may jump, the normal may not: round the fold off, or describe the pieces by regions (breaks "
               "of a rectangle, or a .msh file) that meet with one tangent plane",
               examined.place(kink->at), degrees_between(kink->size));
  return false;
}

void check_curvature(Examined& examined, const JumpSearch& search) {
  // The scale is at least 1e-3 / size: rounding in an almost plane chart is not a curvature.
  double largest = 1e-3 / examined.size;
  for (const fem::Cell& cell : examined.space->cells)
    largest =
        std::max(largest, shape_tensor(examined.surface->frame(cell, mesh::centre(examined.space->shape()))).norm());
  const CellFunction curvature = [&](const fem::Cell& cell, const Vector2d& xi) {
    return Sample(shape_tensor(examined.surface->frame(cell, xi)).reshaped() / largest);
  };
  if (const auto jump = search.in_cells(curvature, 1e-3, Lines::allowed))
    examined.add(Severity::warning,
                 "the curvature of the mid-surface jumps inside of a cell near {}, by {:.3g} 1/m; "
                 "results converge slowly there; {}",
                 examined.place(jump->at), jump->size * largest,
                 examined.surface->coarse().shifts.empty()
                     ? mesh_line
                     : "let the meshes of the mode and of this case have the same cells, or cells as small");
}

/// Returns f divided by the scale in the cells where it acts, zero in others.
CellFunction values_of(const Examined& examined, const NamedExpression& e, double scale) {
  return [&examined, e, scale](const fem::Cell& cell, const Vector2d& xi) {
    if (!e.acts_in(energy::region_of(*examined.space->coarse, cell))) return Sample(Sample::Zero(1));
    double value = 0;
    examined.surface->evaluate(e.f, cell, {&xi, 1}, {&value, 1});
    return Sample(Sample::Constant(1, value / scale));
  };
}

/// Largest magnitude at the nodes; 1 if f is zero there.
double scale_of(const Examined& examined, const NamedExpression& e) {
  const std::size_t count = examined.tables.nodes.size();
  std::vector<double> values(count);
  double largest = 0;
  for (const fem::Cell& cell : examined.space->cells) {
    if (!e.acts_in(energy::region_of(*examined.space->coarse, cell))) continue;
    examined.surface->evaluate(e.f, cell, examined.tables.nodes, values);
    for (const double v : values) largest = std::max(largest, std::abs(v));
  }
  return largest > 0 && std::isfinite(largest) ? largest : 1;
}

/// Returns the thicknesses that are not constant, each with the regions whose cells have it.
std::vector<NamedExpression> thickness_expressions(const Examined& examined) {
  const energy::CrossSections& sections = examined.problem.shell.sections;
  std::vector<NamedExpression> all;
  NamedExpression common{.f = sections.common.thickness};
  for (const std::string& region : examined.space->coarse->regions) {
    const auto own = sections.regions.find(region);
    if (own == sections.regions.end())
      common.regions.push_back(region);
    else if (!own->second.thickness.is_constant())
      all.push_back({.f = own->second.thickness, .regions = {region}});
  }
  if (!common.f.is_constant() && !common.regions.empty()) all.push_back(common);
  return all;
}

void check_thickness(Examined& examined, const JumpSearch& search) {
  for (const NamedExpression& e : thickness_expressions(examined)) {
    const double scale = scale_of(examined, e);
    const CellFunction values = values_of(examined, e, scale);
    auto jump = search.in_cells(values, 1e-6, Lines::allowed);
    if (!jump) jump = search.along_lines(values, 1e-6, Lines::allowed);
    if (jump)
      examined.add(Severity::error,
                   "the thickness {} jumps inside of a cell near {}, by {:.3g} m, and elements "
                   "take it for smooth; {}; or let it change over a length",
                   quoted(e.f), examined.place(jump->at), jump->size * scale, mesh_line);
  }
}

void check_load(Examined& examined, const JumpSearch& search, const NamedExpression& load) {
  const CellFunction values = values_of(examined, load, scale_of(examined, load));
  const auto jump = load.boundary.empty() ? search.in_cells(values, 1e-6, Lines::allowed)
                                          : search.along_boundary(load.boundary, values, 1e-6);
  if (!jump) return;
  if (!jump->is_bounded)
    examined.add(Severity::error, "{} grows without limit near {}; it must be finite everywhere", load.name,
                 examined.place(jump->at));
  else
    examined.add(Severity::note,
                 "{} jumps inside of a cell near {}: cells are divided to integrate it; to have it "
                 "exact, {}",
                 load.name, examined.place(jump->at), mesh_line);
}

}  // namespace

void check_inside_cells(Examined& examined) {
  const JumpSearch search(examined);
  // The patches and directors of a mesh in space are smooth in their cells.
  if (!examined.surface->has_directors() && check_kinks(examined, search)) check_curvature(examined, search);
  check_thickness(examined, search);
  for (const NamedExpression& load : load_expressions(examined.problem)) check_load(examined, search, load);
}

}  // namespace plastron::examination
