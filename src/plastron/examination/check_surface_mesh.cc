// Reports what a mesh in space consists of: parts, orientation, edges by kind, directors; and warns of what is doubtful.
#include <plastron/domain/surface_mesh.hpp>
#include <plastron/examination/checks.hpp>
#include <plastron/topology/surface_flaws.hpp>

#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

namespace plastron::examination {

namespace {

using Findings = std::vector<Finding>;

template <class... Args>
void add(Findings& findings, Severity severity, fmt::format_string<Args...> text, Args&&... args) {
  findings.push_back({severity, fmt::format(text, std::forward<Args>(args)...)});
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::string counted(std::size_t number, const char* one, const char* several) {
  return fmt::format("{} {}", number, number == 1 ? one : several);
}

/// Whether the cells have the normals of the part from which they were made.
bool has_normals(const domain::FileSurface& surface) {
  return std::ranges::none_of(surface.topology.mesh.cells, [](const auto& cell) { return cell.normals.empty(); });
}

/// `names_units`: the case has [units], so that its lengths are meant as they are.
void report_cells(Findings& findings, const domain::FileSurface& surface, const topology::SurfaceSummary& summary,
                  bool names_units) {
  const topology::SpaceMesh& mesh = surface.topology.mesh;
  int least = mesh.cells.front().order, most = least;
  for (const topology::SurfaceCell& cell : mesh.cells) {
    least = std::min(least, cell.order);
    most = std::max(most, cell.order);
  }
  add(findings, Severity::note, "mesh in space: {} {} of order {}, {} in {}; {}", mesh.cells.size(),
      mesh.shape == mesh::Shape::triangle ? "triangles" : "quadrilaterals",
      least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most),
      counted(static_cast<std::size_t>(surface.topology.sheet_count), "smooth sheet", "smooth sheets"),
      counted(static_cast<std::size_t>(surface.topology.part_count), "part", "parts"),
      summary.is_closed ? fmt::format("closed, volume {:.6g} m^3", summary.volume) : "open");
  const double huge = surface.is_remeshed ? 100 : 300;  // files of facets name no unit and are mostly in millimetres
  if (!names_units && (summary.high - summary.low).maxCoeff() > huge)
    add(findings, Severity::warning,
        "the part is {:.4g} m long: if the file is in millimetres, write scale = 1e-3, or give all of the case in "
        "millimetres",
        (summary.high - summary.low).maxCoeff());
  if (surface.merged_nodes > 0)
    add(findings, Severity::note, "{} were at the place of others and are one with them",
        counted(surface.merged_nodes, "node", "nodes"));
  if (least == 1 && !surface.is_remeshed && !has_normals(surface))
    add(findings, Severity::note,
        "cells of order 1 are facets: a curved part needs ten times finer cells than of order 2; export order 2 "
        "(Gmsh: Mesh.ElementOrder = 2, Mesh.SecondOrderIncomplete = 0; Abaqus, CalculiX: S8)");
}

/// Warns of a closed surface whose sides are so near to each other that it is the skin of a thin solid.
void report_skin(Findings& findings, const domain::FileSurface& surface, const topology::SurfaceSummary& summary) {
  constexpr double thin = 0.035;  // balls have 0.27, slender tubes, rings and lenses more than this
  if (!summary.is_closed || surface.topology.components.size() != 1) return;
  Eigen::Vector3d extents = summary.high - summary.low;
  std::ranges::sort(extents);
  const double distance = 2 * std::abs(summary.volume) / summary.area;
  if (distance > thin * std::min(extents[1], std::sqrt(summary.area / 2))) return;
  add(findings, Severity::warning,
      "the surface is closed, and its opposite sides are about {:.3g} m apart: this is the skin of a thin solid, and a "
      "shell is a mid-surface with its own thickness; export or make the mid-surface, or give the file of one side "
      "with offset",
      distance);
}

void report_orientation(Findings& findings, const domain::FileSurface& surface) {
  std::vector<std::string> parts;
  for (const topology::SurfaceComponent& component : surface.topology.components) {
    const char* rule = component.sign == topology::SignRule::outward ? "outwards"
                       : component.sign == topology::SignRule::upper ? "to the side of upper"
                                                                     : "as most cells of the file";
    parts.push_back(fmt::format("{} ({} turned)", rule, component.turned));
  }
  constexpr std::size_t most = 6;
  const std::size_t shown = std::min(most, parts.size());
  add(findings, Severity::note, "a3 points {}{}",
      fmt::join(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(shown), "; "),
      parts.size() > shown ? fmt::format("; and {} more", parts.size() - shown) : "");
}

void report_upper(Findings& findings, const domain::FileSurface& surface) {
  const auto& components = surface.topology.components;
  const auto undecided = std::ranges::count_if(components, [](const topology::SurfaceComponent& component) {
    return !component.is_closed && component.sign != topology::SignRule::upper;
  });
  if (surface.has_upper && undecided > 0)
    add(findings, Severity::warning,
        "upper is at right angles to the mean normal of {} and decides nothing there: a3 points as in the file; choose "
        "another direction",
        counted(static_cast<std::size_t>(undecided), "part of the surface", "parts of the surface"));
}

void report_edges(Findings& findings, const domain::FileSurface& surface, const topology::SurfaceSummary& summary) {
  const auto& [border, smooth, fold, branch] = summary.edges;
  // The limit of facets is one for their angles, not for those of the cells.
  const std::string limit =
      surface.is_remeshed ? "" : fmt::format("; limit {:.3g}", degrees(surface.topology.smooth_angle));
  std::string text =
      fmt::format("edges: {} smooth (up to {:.3g} degrees{})", smooth.number, degrees(smooth.largest_angle), limit);
  if (fold.number > 0)
    text += fmt::format(", {} folds ({:.3g} to {:.3g} degrees)", fold.number, degrees(fold.least_angle),
                        degrees(fold.largest_angle));
  if (branch.number > 0) text += fmt::format(", {} branches of three cells or more", branch.number);
  if (border.number > 0) text += fmt::format(", {} on borders", border.number);
  add(findings, Severity::note, "{}", text);
  if (summary.lone_folds > 0)
    add(findings, Severity::warning,
        "{} of a single edge count as smooth: a fold that no other edge continues cannot be cut; mesh the fold "
        "finer, or set smooth to a larger angle",
        counted(summary.lone_folds, "fold", "folds"));
}

void report_doubtful_edges(Findings& findings, const topology::SurfaceTopology& topology, double limit) {
  if (topology.edges_near_limit.empty()) return;
  const topology::SurfaceEdge& edge = topology.edges[topology.edges_near_limit.front()];
  const Eigen::Vector3d place = (topology.mesh.nodes[static_cast<std::size_t>(edge.ends[0])] +
                                 topology.mesh.nodes[static_cast<std::size_t>(edge.ends[1])]) /
                                2;
  add(findings, Severity::warning,
      "{} between half and twice the limit of {:.3g} degrees, the nearest of {:.3g} degrees at {}: it counts as {}; "
      "set smooth, or name folds, if that is not meant",
      counted(topology.edges_near_limit.size(), "edge has an angle", "edges have angles"), degrees(limit),
      degrees(edge.angle), topology::place_of(place), edge.kind == topology::EdgeKind::fold ? "a fold" : "smooth");
}

void report_directors(Findings& findings, const domain::FileSurface& surface) {
  const topology::DirectorAngle& largest = surface.topology.largest_director_angle;
  add(findings, Severity::note, "directors differ from the cells' normals by at most {:.2g} degrees, at {}",
      degrees(largest.angle), topology::place_of(largest.where));
  constexpr double noticeable = 0.02;
  if (surface.symmetry_turn > noticeable)
    add(findings, Severity::warning,
        "a director on an edge of symmetry was turned by {:.2g} degrees into the plane of symmetry: the cells "
        "there do not meet it at a right angle",
        degrees(surface.symmetry_turn));
}

/// Warns of cells that are nearer to each other than a thickness and of cells that pass through each other.
void report_intersections(Examined& examined, const domain::FileSurface& surface) {
  const energy::CrossSections& sections = examined.problem.shell.sections;
  std::vector<double> thickness;
  for (const std::string& region : surface.regions) {
    const auto own = sections.regions.find(region);
    const geometry::Expression& e = own == sections.regions.end() ? sections.common.thickness : own->second.thickness;
    if (!e.is_constant()) return;
    thickness.push_back(e({}));
  }
  topology::SurfaceFlaws flaws;
  topology::find_intersections(surface.topology.mesh, thickness, flaws);
  for (const topology::Flaw& flaw : flaws.warnings) examined.add(Severity::warning, "{}", flaw.message);
}

/// Distance of a point of the case from the point of the mid-surface that stands for it.
struct Distance {
  Eigen::Vector3d wanted, found;
  double length = 0, half_thickness = 0;

  bool is_far() const { return length > half_thickness; }
};

std::optional<Distance> distance_of(const Examined& examined, const Eigen::Vector3d& wanted,
                                    const Eigen::Vector2d& at) {
  const auto location = fem::locate(examined.surface->coarse(), at);
  if (!location) return {};
  const fem::Cell cell{.coarse = location->coarse};
  double e = 0;
  examined.surface->evaluate(examined.problem.shell.sections.at(*examined.space->coarse, cell).thickness, cell,
                             {&location->xi, 1}, {&e, 1});
  const Eigen::Vector3d found = examined.surface->frame(cell, location->xi, false).phi;
  return Distance{.wanted = wanted, .found = found, .length = (found - wanted).norm(), .half_thickness = e / 2};
}

/// Reports the distance of a point in space. `if_far`: the severity beyond half of the thickness.
void report_distance(Examined& examined, const std::string& what, const std::optional<Distance>& distance,
                     Severity if_far, const std::string& advice = "") {
  if (!distance) return;
  const bool is_far = distance->is_far();
  examined.add(
      is_far ? if_far : Severity::note, "{} {} stands for {}, {:.3g} m away{}", what,
      topology::place_of(distance->wanted), topology::place_of(distance->found), distance->length,
      is_far ? fmt::format(", more than half of the thickness, {:.3g} m{}", distance->half_thickness, advice) : "");
}

/// Reports the point of a line that is farthest from the mid-surface.
void report_line(Examined& examined, const problem::Line& line) {
  std::optional<Distance> worst;
  for (std::size_t k = 0; k < line.in_space.size(); ++k) {
    const auto distance = distance_of(examined, line.in_space[k], line.points[k]);
    if (distance && (!worst || distance->length > worst->length)) worst = distance;
  }
  report_distance(examined, fmt::format("the line \"{}\" at", line.name), worst, Severity::warning);
}

/// A support takes a node of the mesh. A node elsewhere would hold another shell.
void report_points(Examined& examined) {
  for (const problem::Probe& probe : examined.problem.probes)
    if (probe.in_space)
      report_distance(examined, fmt::format("the probe \"{}\" at", probe.name),
                      distance_of(examined, *probe.in_space, probe.at), Severity::warning);
  for (const problem::Line& line : examined.problem.lines) report_line(examined, line);
  for (const assembly::Support& support : examined.problem.shell.supports)
    if (support.point_in_space && support.point)
      report_distance(examined, "the support at the point",
                      distance_of(examined, *support.point_in_space, *support.point), Severity::error,
                      ": give the place of a corner of a cell, for even degrees also of the middle of a side or cell");
}

}  // namespace

std::vector<Finding> surface_findings(const domain::FileSurface& surface, bool names_units) {
  Findings findings;
  const topology::SurfaceSummary summary = topology::summary_of(surface.topology);
  report_cells(findings, surface, summary, names_units);
  report_skin(findings, surface, summary);
  report_orientation(findings, surface);
  report_upper(findings, surface);
  report_edges(findings, surface, summary);
  report_doubtful_edges(findings, surface.topology, surface.topology.smooth_angle);
  report_directors(findings, surface);
  for (const std::string& note : surface.notes) add(findings, Severity::note, "{}", note);
  for (const std::string& warning : surface.warnings) add(findings, Severity::warning, "{}", warning);
  return findings;
}

void check_surface_mesh(Examined& examined) {
  report_points(examined);
  const auto* file = std::get_if<domain::MeshFile>(&examined.problem.domain);
  if (!file || !file->in_space || file->path.empty()) return;
  const domain::FileSurface surface = domain::read_surface(*file, examined.problem.discretisation.cells);
  examined.symmetry_accuracy = surface.symmetry_accuracy;
  std::ranges::move(surface_findings(surface, examined.problem.output.units.are_stated),
                    std::back_inserter(examined.findings));
  report_intersections(examined, surface);
}

}  // namespace plastron::examination
