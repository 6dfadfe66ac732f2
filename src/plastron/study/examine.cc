#include <plastron/study/examine.hpp>

#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/study/gap.hpp>
#include <plastron/study/locking.hpp>
#include <plastron/study/rigid_motions.hpp>
#include <plastron/study/seams.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace plastron::study {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A mesh of some thousand sample points, the same for every rank.
fem::MeshSequence sample_mesh(const Problem& problem) {
  constexpr int enough_cells = 256;
  const Discretisation& d = problem.discretisation;
  const int degree = d.cells == fem::Shape::triangle ? d.degree : std::clamp(d.degree, 2, 4);
  fem::MeshSequence meshes(fem::coarse_mesh(problem.domain, d.cells), degree, MPI_COMM_SELF);
  while (meshes.space()->global_cells < enough_cells) meshes.refine({});
  return meshes;
}

class Examination {
 public:
  explicit Examination(const Problem& problem)
      : problem_(problem),
        meshes_(sample_mesh(problem)),
        space_(meshes_.space()),
        surface_(space_->coarse, problem.charts),
        tables_(assembly::element_tables(space_->shape(), space_->degree, false)) {}

  std::vector<Finding> run() {
    names();
    if (has_errors(findings_)) return std::move(findings_);
    if (!surface()) return std::move(findings_);
    normals();
    for (const std::string& warning : locking_warnings(problem_)) add(Severity::warning, "{}", warning);
    for (const std::string& warning : seam_warnings(*space_, surface_)) add(Severity::warning, "{}", warning);
    probes();
    nodes();
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void add(Severity severity, fmt::format_string<Args...> text, Args&&... args) {
    findings_.push_back({severity, fmt::format(text, std::forward<Args>(args)...)});
  }

  void names() {
    const auto& known = space_->coarse->boundaries;
    const auto check = [&](const std::string& name, const char* what) {
      if (std::ranges::find(known, name) == known.end())
        add(Severity::error, "{} names the boundary \"{}\", which the mesh does not have; it has: {}", what, name,
            fmt::join(known, ", "));
    };
    for (const auto& s : problem_.supports) check(s.boundary, "a support");
    for (const auto& l : problem_.edge_loads) check(l.boundary, "a load");
  }

  /// Chart, thickness and curvature at sample points; false if the chart cannot be used.
  bool surface() {
    double thinnest = INFINITY, thickest = 0, sharpest = 0, area = 0;
    const auto& xi = tables_.quadrature.xi;
    std::vector<geometry::SurfaceJet> jets(xi.size());
    std::vector<double> x(xi.size()), y(xi.size()), e(xi.size());
    for (const fem::Cell& cell : space_->cells) {
      surface_.positions(cell, xi, x, y);
      surface_.jets(cell, xi, jets);
      problem_.thickness.evaluate(x, y, e);
      for (std::size_t p = 0; p < xi.size(); ++p) {
        if (!regular(jets[p], x[p], y[p]) || !thick(e[p], x[p], y[p])) return false;
        const geometry::Frame frame = geometry::frame_at(jets[p]);
        const auto kappa = geometry::principal_curvatures(frame);
        const double bending = e[p] / 2 * std::max(std::abs(kappa[0]), std::abs(kappa[1]));
        if (!(bending < 1)) {
          add(Severity::error,
              "the shell is too thick for its curvature at x = {:.6g}, y = {:.6g}: thickness {:g} times largest "
              "curvature {:g}, halved, is {:.3g} and must stay below 1; reduce the thickness or flatten the chart "
              "there",
              x[p], y[p], e[p], 2 * bending / e[p], bending);
          return false;
        }
        thinnest = std::min(thinnest, e[p]);
        thickest = std::max(thickest, e[p]);
        sharpest = std::max(sharpest, bending);
        is_developable_ =
            is_developable_ && std::abs(kappa[0] * kappa[1]) <= 1e-9 * (kappa[0] * kappa[0] + kappa[1] * kappa[1]);
        area += frame.sqrt_a * tables_.weights[p];
      }
      if (!usable_nodes(cell)) return false;
    }
    add(Severity::note, "chart: regular at {} sample points, mid-surface area {:.6g} m^2",
        space_->cells.size() * xi.size(), area);
    add(Severity::note, "thickness: {:.4g} to {:.4g} m; e |kappa| / 2 at most {:.3g} (must stay below 1)", thinnest,
        thickest, sharpest);
    if (sharpest > 0.3)
      add(Severity::warning,
          "e |kappa| / 2 reaches {:.2g}: a shell model is doubtful where the thickness is a sizeable part of the "
          "radius",
          sharpest);
    return true;
  }

  /// Edges of the domain hold nodes but no quadrature points.
  bool usable_nodes(const fem::Cell& cell) {
    const std::size_t count = tables_.nodes.size();
    std::vector<geometry::SurfaceJet> jets(count);
    std::vector<double> x(count), y(count), e(count);
    surface_.positions(cell, tables_.nodes, x, y);
    surface_.jets(cell, tables_.nodes, jets, false);
    problem_.thickness.evaluate(x, y, e);
    for (std::size_t i = 0; i < count; ++i)
      if (!regular(jets[i], x[i], y[i]) || !thick(e[i], x[i], y[i])) return false;
    return true;
  }

  bool regular(const geometry::SurfaceJet& jet, double x, double y) {
    bool finite = jet.value.allFinite();
    for (const auto& d : jet.d) finite = finite && d.allFinite();
    for (const auto& d : jet.dd) finite = finite && d.allFinite();
    if (!finite) {
      add(Severity::error,
          "the chart or one of its derivatives is not finite at x = {:.6g}, y = {:.6g}; the domain must stay "
          "inside of where the expressions are smooth",
          x, y);
      return false;
    }
    const double sine = geometry::tangent_sine(jet);
    if (sine > geometry::degenerate_sine) return true;
    add(Severity::error,
        "the chart is degenerate at x = {:.6g}, y = {:.6g}: its tangents a_1 and a_2 are parallel or zero "
        "(|a_1 x a_2| = {:.2g}); choose parameters in which phi has independent tangents",
        x, y, jet.d[0].cross(jet.d[1]).norm());
    return false;
  }

  bool thick(double e, double x, double y) {
    if (e > 0) return true;
    add(Severity::error,
        "the thickness is {:g} at x = {:.6g}, y = {:.6g}; it must be positive everywhere in the domain", e, x, y);
    return false;
  }

  /// phi and a_3 must agree where cells meet; second derivatives may jump.
  void normals() {
    constexpr double tolerance = 1e-6;
    struct Seen {
      bool is = false;
      Vector3d phi, a3;
    };
    std::vector<Seen> seen(static_cast<std::size_t>(space_->layout->owned));
    std::vector<geometry::SurfaceJet> jets(tables_.nodes.size());
    std::vector<double> x(jets.size()), y(jets.size());
    for (std::size_t c = 0; c < space_->cells.size(); ++c) {
      surface_.jets(space_->cells[c], tables_.nodes, jets, false);
      surface_.positions(space_->cells[c], tables_.nodes, x, y);
      for (std::size_t i = 0; i < jets.size(); ++i) {
        const Vector3d a3 = geometry::unit_normal(jets[i]);
        Seen& first = seen[static_cast<std::size_t>(space_->nodes(c)[i])];
        if (!first.is) {
          first = {true, jets[i].value, a3};
        } else if ((first.phi - jets[i].value).norm() > tolerance * (1 + first.phi.norm())) {
          return add(Severity::error,
                     "the charts of two regions do not meet at x = {:.6g}, y = {:.6g}: they are {:.3g} m apart; "
                     "the mid-surface must be continuous",
                     x[i], y[i], (first.phi - jets[i].value).norm());
        } else if ((first.a3 - a3).norm() > tolerance) {
          return add(Severity::error,
                     "the mid-surface has a kink at x = {:.6g}, y = {:.6g}: the normals of two regions differ by "
                     "{:.3g} rad; curvature may jump there, the normal may not",
                     x[i], y[i], (first.a3 - a3).norm());
        }
      }
    }
    if (space_->coarse->regions.size() > 1)
      add(Severity::note, "regions {} meet with one normal", fmt::join(space_->coarse->regions, ", "));
  }

  void probes() {
    for (const Probe& p : problem_.probes)
      if (!fem::locate(*space_->coarse, p.at))
        add(Severity::error, "the probe \"{}\" at ({:g}, {:g}) lies outside of the domain", p.name, p.at[0], p.at[1]);
  }

  void nodes() {
    const auto points = assembly::nodal_geometry(*space_, surface_, tables_, problem_.thickness);
    const assembly::GapFunction gap = gap_function(problem_);
    try {
      symmetry_planes(points);
      const auto coordinates = assembly::nodal_coordinates(*space_, surface_, points, problem_.supports, gap,
                                                           problem_.discretisation.tangency.formulation);
      if (gap) initial_gap(points, coordinates);
      formulation(coordinates);
      rigid_motions(points, coordinates);
    } catch (const assembly::SupportError& error) {
      add(Severity::error, "{}", error.what());
    }
  }

  /// What a formulation asks of chart and supports.
  void formulation(const assembly::NodalCoordinates& coordinates) {
    using assembly::Formulation;
    const Formulation kind = problem_.discretisation.tangency.formulation;
    if (kind == Formulation::classical && problem_.charts.size() > 1)
      add(Severity::error,
          "the classical formulation needs a smooth chart, and the regions {} have charts of their own, where "
          "curvature may jump; use formulation = \"tangent\"",
          fmt::join(space_->coarse->regions, ", "));
    if (!assembly::is_relaxed(kind)) return;
    for (std::size_t i = 0; i < coordinates.basis.size(); ++i)
      if (coordinates.is_prescribed(i, 5)) return;
    add(Severity::error,
        "the {} formulation sees only the gradient of r . a3, and no support fixes a component of r: a constant r . a3 "
        "is "
        "left free{}; add \"r.a3\" to the fix of a support, or use formulation = \"tangent\"",
        assembly::to_string(kind),
        is_developable_ ? ", and on this developable chart it is part of a seventh motion beside the six rigid ones "
                          "that costs no energy"
                        : "");
  }

  /// A symmetry edge must lie in one plane that the shell meets at a right angle: one conormal along the whole edge.
  void symmetry_planes(const std::vector<assembly::NodalPoint>& points) {
    for (const assembly::Support& support : problem_.supports) {
      if (!support.symmetry) continue;
      const auto rows = assembly::node_supports(*space_, surface_, points, {support});
      const Vector3d* first = nullptr;
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (const auto& [direction, value] : rows[i].displacement) {
          if (!first) first = &direction;
          if ((direction - *first).norm() < 1e-6) continue;
          return add(
              Severity::error,
              "the boundary \"{}\" is no symmetry plane: its conormal turns (at x = {:.6g}, y = {:.6g} by {:.3g} rad); "
              "symmetry needs a plane edge that the shell meets at a right angle",
              support.boundary, points[i].x[0], points[i].x[1], (direction - *first).norm());
        }
    }
  }

  void initial_gap(const std::vector<assembly::NodalPoint>& points, const assembly::NodalCoordinates& coordinates) {
    double least = INFINITY, most = -INFINITY;
    std::size_t at = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double g = coordinates.gaps[i].initial;
      if (g < least) {
        least = g;
        at = i;
      }
      most = std::max(most, g);
      if (is_held_inside(coordinates, points[i], i))
        return add(
            Severity::error,
            "the support of the boundary {} holds the shell inside of the obstacle at x = {:.6g}, y = {:.6g}: its face "
            "lies {:.4g} m deep there and cannot move; lower the obstacle or move the support",
            supports_of(i, points), points[i].x[0], points[i].x[1], -coordinates.bound_gap[i]);
    }
    add(least < 0 ? Severity::warning : Severity::note,
        "initial gap: {:.4g} m (at x = {:.4g}, y = {:.4g}) to {:.4g} m{}", least, points[at].x[0], points[at].x[1],
        most, least < 0 ? "; the undeformed shell reaches into the obstacle and will be pushed out" : "");
  }

  /// The boundaries whose supports act at a node, each in quotes.
  std::string supports_of(std::size_t node, const std::vector<assembly::NodalPoint>& points) const {
    std::vector<std::string> names;
    for (const assembly::Support& support : problem_.supports) {
      const auto rows = assembly::node_supports(*space_, surface_, points, {support});
      const std::string name = fmt::format("\"{}\"", support.boundary);
      if ((!rows[node].displacement.empty() || !rows[node].rotation.empty()) &&
          std::ranges::find(names, name) == names.end())
        names.push_back(name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
  }

  void rigid_motions(const std::vector<assembly::NodalPoint>& points, const assembly::NodalCoordinates& coordinates) {
    const FreeMotions free = free_rigid_motions(points, coordinates);
    for (const std::string& motion : free.unheld)
      add(Severity::error,
          "the supports leave a rigid motion free: {}; fix more components, or say on which boundaries", motion);
    for (const std::string& motion : free.held_by_obstacle)
      add(Severity::warning,
          "only the obstacle can hold the rigid motion: {}; the problem is singular unless the loads press the shell "
          "onto it",
          motion);
    if (free.unheld.empty() && free.held_by_obstacle.empty())
      add(Severity::note, "supports: no rigid motion is left free");
  }

  const Problem& problem_;
  fem::MeshSequence meshes_;
  std::shared_ptr<const fem::Space> space_;
  fem::Surface surface_;
  assembly::ElementTables tables_;
  std::vector<Finding> findings_;
  bool is_developable_ = true;  ///< no Gaussian curvature at any sample point
};

}  // namespace

bool has_errors(const std::vector<Finding>& findings) {
  return std::ranges::any_of(findings, [](const Finding& f) { return f.severity == Severity::error; });
}

std::vector<Finding> examine(const Problem& problem) {
  try {
    return Examination(problem).run();
  } catch (const fem::DomainError& error) {
    return {{Severity::error, error.what()}};
  }
}

}  // namespace plastron::study
