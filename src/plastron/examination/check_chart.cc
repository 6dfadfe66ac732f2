// Checks that the chart is regular and finite, and the thickness positive and small against the radii of curvature
// (M1 to M3).
#include <plastron/examination/checks.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/shell/material.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::examination {

namespace {

bool is_finite(const geometry::Frame& frame) {
  bool finite = frame.phi.allFinite() && frame.b_cov.allFinite();
  for (const auto& a : frame.a_cov) finite = finite && a.allFinite();
  return finite;
}

/// Checks sample points until one is unusable.
class ChartCheck {
 public:
  explicit ChartCheck(Examined& examined) : examined_(examined) {}

  void run() {
    for (const fem::Cell& cell : examined_.space->cells)
      for (const geometry::Frame& frame : samples(cell, examined_.tables.nodes, false).frames)
        if (std::isfinite(frame.sqrt_a)) largest_element_ = std::max(largest_element_, frame.sqrt_a);
    for (const fem::Cell& cell : examined_.space->cells)
      if (!usable_points(cell) || !usable_nodes(cell)) return;
    examined_.size = (high_ - low_).norm() / 2;
    examined_.is_developable = flattest_ <= 1e-9 * std::max(roundest_, 1 / examined_.size);
    const std::size_t points = examined_.space->cells.size() * examined_.tables.weights.size();
    examined_.add(Severity::note, "{}: regular at {} sample points, mid-surface area {:.6g} m^2",
                  examined_.surface->has_directors() ? "surface" : "chart", points, area_);
    examined_.add(Severity::note, "thickness: {:.4g} to {:.4g} m; e |kappa| / 2 at most {:.3g} (must stay below 1)",
                  thinnest_, thickest_, sharpest_);
    check_proportions();
    if (sharpest_ > 0.3)
      examined_.add(Severity::warning,
                    "e |kappa| / 2 reaches {:.2g}: a shell model is doubtful where the thickness is a sizeable part of "
                    "the radius",
                    sharpest_);
  }

 private:
  void check_proportions() {
    constexpr double very_thin = 1e-4, doubtful = 0.5, no_shell = 1.5;  // parts of half the diagonal
    if (thinnest_ < very_thin * examined_.size)
      examined_.add(Severity::note,
                    "the diagonal of the box that holds the mid-surface is {:.2g} times the thickness, which is rare: "
                    "check that the thickness and the geometry have the same unit of length (scale in [geometry] "
                    "multiplies the lengths of a mesh file)",
                    2 * examined_.size / thinnest_);
    if (!(thickest_ > doubtful * examined_.size)) return;
    examined_.add(
        thickest_ > no_shell * examined_.size ? Severity::error : Severity::warning,
        "the shell is {:.4g} m thick, and the diagonal of the box that holds its mid-surface measures {:.4g} m: "
        "a shell's thickness is a small part of its extent, a tenth or less; check the units of the thickness "
        "and of the geometry, or compute a solid with another program",
        thickest_, 2 * examined_.size);
  }

  bool usable_points(const fem::Cell& cell) {
    const auto& xi = examined_.tables.quadrature.xi;
    const Samples s = samples(cell, xi, true);
    for (std::size_t p = 0; p < xi.size(); ++p) {
      const geometry::Frame& frame = s.frames[p];
      if (!regular(frame, s.x[p], s.y[p]) || !thick(s.e[p], s.x[p], s.y[p])) return false;
      if (!thin(frame, s.e[p], s.x[p], s.y[p]) || !has_axes(cell, s, p)) return false;
      area_ += frame.sqrt_a * examined_.tables.weights[p];
    }
    return true;
  }

  /// Checks the nodes, because edges of the domain contain nodes but no quadrature points.
  bool usable_nodes(const fem::Cell& cell) {
    const Samples s = samples(cell, examined_.tables.nodes, false);
    for (std::size_t i = 0; i < s.frames.size(); ++i) {
      if (!regular(s.frames[i], s.x[i], s.y[i]) || !thick(s.e[i], s.x[i], s.y[i]) || !has_axes(cell, s, i))
        return false;
      low_ = low_.cwiseMin(s.frames[i].phi);
      high_ = high_.cwiseMax(s.frames[i].phi);
    }
    return true;
  }

  struct Samples {
    std::vector<double> x, y, e;
    std::vector<geometry::Frame> frames;
  };
  Samples samples(const fem::Cell& cell, const std::vector<Eigen::Vector2d>& xi, bool second_derivatives) const {
    const std::size_t n = xi.size();
    Samples s{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n), {}};
    s.frames.resize(n);
    examined_.surface->positions(cell, xi, s.x, s.y);
    examined_.surface->frames(cell, xi, s.frames, second_derivatives);
    examined_.surface->evaluate(examined_.problem.shell.sections.at(*examined_.space->coarse, cell).thickness, cell, xi,
                                s.e);
    return s;
  }

  bool regular(const geometry::Frame& frame, double x, double y) {
    // A tangent that is zero up to rounding may be perpendicular to the other one. Degenerate tangents have no normal.
    const bool is_degenerate = frame.a_cov[0].allFinite() && frame.a_cov[1].allFinite() &&
                               !(geometry::tangent_sine(frame) > geometry::degenerate_sine &&
                                 frame.sqrt_a > geometry::degenerate_sine * largest_element_);
    if (!is_degenerate && !is_finite(frame)) {
      examined_.add(Severity::error,
                    "the chart or one of its derivatives is not finite at {}; the domain must stay "
                    "inside of where the expressions are smooth",
                    examined_.place({x, y}));
      return false;
    }
    if (!is_degenerate) return true;
    examined_.add(Severity::error,
                  "the chart is degenerate at {}: its tangents a_1 and a_2 are parallel or zero "
                  "(|a_1 x a_2| = {:.2g}); choose parameters in which phi has independent tangents",
                  examined_.place({x, y}), frame.sqrt_a);
    return false;
  }

  bool has_axes(const fem::Cell& cell, const Samples& s, std::size_t p) {
    const auto laminate = examined_.problem.shell.sections.at(*examined_.space->coarse, cell).material.laminate();
    if (!laminate || laminate->has_axes(s.frames[p].a3)) return true;
    examined_.add(Severity::error,
                  "the material's direction is normal to the shell at {}, so that its axis 1 is not "
                  "known there; choose a direction that is nowhere within half a degree of the normal a3",
                  examined_.place({s.x[p], s.y[p]}));
    return false;
  }

  bool thick(double e, double x, double y) {
    if (e > 0 && std::isfinite(e)) return true;
    examined_.add(Severity::error,
                  "the thickness is {:g} at {}; it must be positive and finite everywhere in the "
                  "domain",
                  e, examined_.place({x, y}));
    return false;
  }

  bool thin(const geometry::Frame& frame, double e, double x, double y) {
    const auto kappa = geometry::principal_curvatures(frame);
    const double bending = e / 2 * std::max(std::abs(kappa[0]), std::abs(kappa[1]));
    if (!(bending < 1)) {
      examined_.add(Severity::error,
                    "the shell is too thick for its curvature at {}: thickness {:g} times largest "
                    "curvature {:g}, halved, is {:.3g} and must stay below 1; reduce the thickness or curve the "
                    "surface less there{}",
                    examined_.place({x, y}), e, 2 * bending / e, bending,
                    examined_.surface->has_directors()
                        ? "; a mesh with few cells over a fillet is curved more than the part: mesh it finer there"
                        : "");
      return false;
    }
    thinnest_ = std::min(thinnest_, e);
    thickest_ = std::max(thickest_, e);
    sharpest_ = std::max(sharpest_, bending);
    flattest_ = std::max(flattest_, std::min(std::abs(kappa[0]), std::abs(kappa[1])));
    roundest_ = std::max(roundest_, std::max(std::abs(kappa[0]), std::abs(kappa[1])));
    return true;
  }

  Examined& examined_;
  double largest_element_ = 0;  ///< |a_1 x a_2| at the nodes
  double thinnest_ = INFINITY, thickest_ = 0, sharpest_ = 0, area_ = 0;
  double flattest_ = 0, roundest_ = 0;  // largest smaller and largest larger principal curvature [1/m]
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(INFINITY), high_ = -low_;  ///< box of the mid-surface
};

}  // namespace

void check_chart(Examined& examined) { ChartCheck(examined).run(); }

}  // namespace plastron::examination
