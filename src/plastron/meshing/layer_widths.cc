#include <plastron/meshing/layer_widths.hpp>

#include <plastron/domain/domain.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/meshing/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plastron::meshing {

namespace {

using Eigen::Vector2d;

/// Part of a boundary in one region: points at equal distances, with unit normals into the domain.
struct Piece {
  int boundary = 0, region = 0;
  double length = 0;  ///< in Omega
  std::vector<Vector2d> points{}, inwards{};
};

constexpr int samples = constants.edge_samples;

Piece straight_piece(int boundary, int region, const Vector2d& from, const Vector2d& to, const Vector2d& inward) {
  Piece piece{.boundary = boundary, .region = region, .length = (to - from).norm()};
  for (int i = 0; i < samples; ++i) {
    piece.points.push_back(from + (to - from) * (i + 0.5) / samples);
    piece.inwards.push_back(inward);
  }
  return piece;
}

Piece circle(int boundary, const Vector2d& centre, double radius, double sign) {
  Piece piece{.boundary = boundary, .length = 2 * std::numbers::pi * radius};
  for (int i = 0; i < samples; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / samples;
    const Vector2d outward(std::cos(angle), std::sin(angle));
    piece.points.push_back(centre + radius * outward);
    piece.inwards.push_back(sign * outward);
  }
  return piece;
}

struct Pieces {
  std::vector<Piece> operator()(const domain::Rectangle& r) const {
    std::vector<double> ends{r.from[0]};
    ends.insert(ends.end(), r.breaks.begin(), r.breaks.end());
    ends.push_back(r.to[0]);
    const int last = static_cast<int>(ends.size()) - 2;
    std::vector<Piece> pieces{straight_piece(0, 0, r.from, {r.from[0], r.to[1]}, Vector2d::UnitX()),
                              straight_piece(1, last, {r.to[0], r.from[1]}, r.to, -Vector2d::UnitX())};
    for (int i = 0; i <= last; ++i) {
      const double a = ends[i], b = ends[static_cast<std::size_t>(i) + 1];
      pieces.push_back(straight_piece(2, i, {a, r.from[1]}, {b, r.from[1]}, Vector2d::UnitY()));
      pieces.push_back(straight_piece(3, i, {a, r.to[1]}, {b, r.to[1]}, -Vector2d::UnitY()));
    }
    return pieces;
  }
  std::vector<Piece> operator()(const domain::Disk& d) const { return {circle(0, d.centre, d.radius, -1)}; }
  std::vector<Piece> operator()(const domain::Annulus& a) const {
    return {circle(0, a.centre, a.inner, 1), circle(1, a.centre, a.outer, -1)};
  }
  std::vector<Piece> operator()(const domain::Polygon& polygon) const {
    const auto& p = polygon.corners;
    const double sense = domain::signed_area(polygon) > 0 ? 1 : -1;
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vector2d& q = p[(i + 1) % p.size()];
      const Vector2d along = (q - p[i]).normalized() * sense;
      pieces.push_back(straight_piece(static_cast<int>(i), 0, p[i], q, {-along[1], along[0]}));
    }
    return pieces;
  }
  std::vector<Piece> operator()(const domain::MeshFile&) const { return {}; }
};

const std::string& region_name(const std::vector<std::string>& names, int region) { return names[region]; }

const geometry::Expression& thickness_of(const energy::CrossSections& sections, const std::string& region) {
  const auto own = sections.regions.find(region);
  return own == sections.regions.end() ? sections.common.thickness : own->second.thickness;
}

/// Returns b(v, w) for tangents given by their components in the parameters.
double form(const Eigen::Matrix2d& matrix, const Vector2d& v, const Vector2d& w) { return v.dot(matrix * w); }

EdgeLayer layer_along(const Piece& piece, const geometry::Chart& chart, const geometry::Expression& thickness) {
  LayerCurvatures squares;
  double e = 0, across = 0, along = 0;
  for (std::size_t i = 0; i < piece.points.size(); ++i) {
    const Vector2d &x = piece.points[i], &inward = piece.inwards[i];
    const geometry::Frame frame = geometry::frame_at(chart(x[0], x[1]));
    const Vector2d t(inward[1], -inward[0]);
    const double tt = form(frame.metric_cov, t, t);
    const Vector2d n = inward - form(frame.metric_cov, inward, t) / tt * t;
    const double nn = form(frame.metric_cov, n, n);
    squares.along += std::pow(form(frame.b_cov, t, t) / tt, 2) / samples;
    squares.twist += std::pow(form(frame.b_cov, n, t), 2) / (nn * tt) / samples;
    squares.across += std::pow(form(frame.b_cov, n, n) / nn, 2) / samples;
    e += thickness({x[0], x[1], frame.phi[0], frame.phi[1], frame.phi[2]}) / samples;
    across += std::sqrt(nn) / samples;
    along += std::sqrt(tt) / samples;
  }
  const LayerCurvatures curvatures{std::sqrt(squares.along), std::sqrt(squares.twist), std::sqrt(squares.across)};
  const double width = layer_width(e, curvatures, along * piece.length);
  return {.boundary = piece.boundary, .region = piece.region, .width = width, .width_in_omega = width / across};
}

/// Sums over points spread over the cells of a mesh.
struct Sums {
  double area = 0, gauss = 0, trace = 0, thickness = 0;
  Vector2d stretch = Vector2d::Zero();

  void add(const geometry::SurfaceJet& phi, double weight, double e) {
    const geometry::Frame frame = geometry::frame_at(phi);
    const auto [low, high] = geometry::principal_curvatures(frame);
    const double dS = weight * frame.sqrt_a;
    area += dS;
    gauss += dS * low * high;
    trace += dS * std::abs(low + high);
    thickness += dS * e;
    stretch += dS * Vector2d(phi.d[0].norm(), phi.d[1].norm());
  }
  /// Returns the layer width along an asymptotic line, where b_tt = 0 and b_nt^2 = -K; b_nn then is the trace.
  double layer() const {
    const double K = gauss / area, flat = constants.flat_curvature * std::pow(trace / area, 2);
    if (K > flat) return INFINITY;
    return layer_width(thickness / area, {.along = 0, .twist = std::sqrt(std::max(0.0, -K)), .across = trace / area},
                       std::sqrt(area));
  }
};

}  // namespace

double layer_width(double thickness, const LayerCurvatures& c, double length) {
  const auto held = [&](double l) {
    const double s = l / length;
    return l * l * (c.along + 2 * c.twist * s + c.across * s * s);
  };
  if (!(held(1e6 * length) > thickness)) return INFINITY;
  double low = 0, high = 1e6 * length;
  for (int i = 0; i < 200 && high > (1 + 1e-12) * low; ++i) {
    const double middle = (low + high) / 2;
    (held(middle) < thickness ? low : high) = middle;
  }
  return high;
}

std::vector<EdgeLayer> edge_layers(const problem::Problem& problem) {
  const auto names = domain::region_names(problem.domain);
  std::vector<EdgeLayer> layers;
  for (const Piece& piece : std::visit(Pieces{}, problem.domain)) {
    const std::string& region = region_name(names, piece.region);
    const geometry::Chart& chart = fem::chart_of_region(problem.charts, region);
    layers.push_back(layer_along(piece, chart, thickness_of(problem.shell.sections, region)));
  }
  return layers;
}

Interior interior(const problem::Problem& problem) {
  constexpr int n = constants.interior_samples;
  auto coarse =
      std::make_shared<const mesh::CoarseMesh>(domain::coarse_mesh(problem.domain, mesh::Shape::quadrilateral));
  const fem::Surface surface(coarse, problem.charts);
  std::vector<Vector2d> xi;
  xi.reserve(n * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) xi.emplace_back((i + 0.5) / n, (j + 0.5) / n);
  std::vector<geometry::SurfaceJet> jets(xi.size());
  std::vector<double> e(xi.size());
  std::vector<Sums> by_region(coarse->regions.size());
  for (std::size_t c = 0; c < coarse->cells.size(); ++c) {
    const fem::Cell cell{.coarse = static_cast<int>(c)};
    surface.parameter_jets(cell, xi, jets);
    surface.evaluate(problem.shell.sections.at(*coarse, cell).thickness, cell, xi, e);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const geometry::PlaneJet map = coarse->cells[c].map(xi[i]);
      const double weight = std::abs(map.d[0][0] * map.d[1][1] - map.d[0][1] * map.d[1][0]) / (n * n);
      by_region[coarse->cells[c].region].add(jets[i], weight, e[i]);
    }
  }
  Interior result{.area = 0, .width = INFINITY, .stretch = Vector2d::Zero()};
  for (const Sums& sums : by_region) {
    result.area += sums.area;
    result.width = std::min(result.width, sums.layer());
    result.stretch += sums.stretch;
  }
  result.stretch /= result.area;
  return result;
}

}  // namespace plastron::meshing
