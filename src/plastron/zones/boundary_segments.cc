#include <plastron/zones/boundary_segments.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/shell/material.hpp>
#include <plastron/solution/nodal_solution.hpp>
#include <plastron/zones/gap_opening.hpp>
#include <plastron/zones/sub_cells.hpp>

#include <algorithm>

namespace plastron::zones {

namespace {

using algebra::GlobalIndex, algebra::LocalIndex;

/// Two nodes of a cell, the first in contact. The end is the boundary's point between them, or the node itself if
/// they are equal.
struct CellEnd {
  int touching, other;
};

constexpr double rounding_of_xi = 1e-12;  // relative to reference cells

/// The segments of this rank's cells.
class Marching {
 public:
  Marching(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, std::size_t obstacle,
           const TouchingNodes& touching, const ZoneLabels& labels, const GapOpening& opening)
      : discrete_(discrete),
        space_(discrete.space()),
        solution_(solution),
        gaps_(discrete.coordinates.gaps[obstacle]),
        touching_(touching),
        labels_(labels),
        opening_(opening),
        borders_(space_.cells.size(), 0),
        is_at_hanging_(static_cast<std::size_t>(space_.layout->local_size()), 0),
        areas_(static_cast<std::size_t>(labels.count), 0) {
    for (const auto* sides : {&space_.sides, &space_.twin_sides})
      for (const fem::BoundarySide& side : *sides) borders_[side.cell] |= 1U << side.side;
    for (const constraints::Row& row : space_.continuity.rows()) {
      if (row.terms.size() < 2) continue;
      is_at_hanging_[static_cast<std::size_t>(row.node)] = 1;
      for (const constraints::Term& term : row.terms) is_at_hanging_[static_cast<std::size_t>(term.node)] = 1;
    }
  }

  ZoneBoundaries operator()() {
    const auto subs = sub_cells(space_.shape(), space_.degree);
    for (std::size_t c = 0; c < space_.owned_cells; ++c) {
      cell_ = c;
      const auto inside = [this](LocalIndex i) { return touching_[i]; };
      if (std::ranges::all_of(space_.nodes(c), inside)) {
        area_of_zone(0) += discrete_.shell.area(c);
        continue;
      }
      for (const SubCell& sub : subs) march(sub);
      place_new_ends();
    }
    const fem::BoundarySide* last = nullptr;
    for (const fem::BoundarySide& side : space_.sides) {
      // A side with several names occurs several times.
      const bool is_seen = last && last->cell == side.cell && last->side == side.side;
      last = &side;
      if (is_seen || side.is_inner || side.cell >= space_.owned_cells) continue;
      cell_ = side.cell;
      follow_rim(side.side);
      place_new_ends();
    }
    return {std::move(segments_), std::move(areas_)};
  }

 private:
  LocalIndex node(int i) const { return space_.nodes(cell_)[static_cast<std::size_t>(i)]; }
  bool touches(int i) const { return touching_[node(i)]; }

  /// The area of the zone of a touching node of the cell.
  double& area_of_zone(int touching) {
    return areas_[static_cast<std::size_t>(labels_.of_node[static_cast<std::size_t>(node(touching))])];
  }

  /// Cuts off each run of free corners, so that touching corners stay together because they belong to one zone.
  void march(const SubCell& sub) {
    const std::size_t n = sub.size();
    std::vector<Eigen::Vector2d> outline;  // corners of the remaining polygon
    double area = 0;
    int touching = -1;
    for (std::size_t i = 0; i < n; ++i) {
      if (!touches(sub[i])) continue;
      touching = sub[i];
      outline.push_back(reference_point(sub[i]));
      if (touches(sub[(i + 1) % n])) continue;
      std::size_t j = i + 1;
      while (!touches(sub[(j + 1) % n])) ++j;
      const CellEnd from{sub[i], sub[(i + 1) % n]}, to{sub[(j + 1) % n], sub[j % n]};
      const auto [a, b] = add(from, to, false);
      outline.insert(outline.end(), {a, b});
      area += bulge(from, a, b);
    }
    if (touching < 0) return;
    for (std::size_t i = 2; i < outline.size(); ++i) area += triangle_area(outline[0], outline[i - 1], outline[i]);
    area_of_zone(touching) += area;
  }

  /// The area between a segment and the parabola through the edge at its middle [m^2]. Positive where the zone
  /// extends beyond the segment.
  double bulge(const CellEnd& from, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    constexpr double of_triangle = 4.0 / 3;
    return of_triangle * triangle_area(a, edge_near(from, (a + b) / 2), b);
  }

  /// The triangle's area on the mid-surface, with the sign of its orientation; a rule of degree 2 for sqrt(a) [m^2].
  double triangle_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) const {
    const Eigen::Vector2d one = b - a, other = c - a;
    const std::array<Eigen::Vector2d, 3> middles{(a + b) / 2, (b + c) / 2, (c + a) / 2};
    std::array<geometry::Frame, 3> frames;
    discrete_.shell.surface().frames(space_.cells[cell_], middles, frames, false);
    double sum = 0;
    for (const geometry::Frame& frame : frames) sum += frame.sqrt_a;
    return sum / 3 * (one[0] * other[1] - one[1] * other[0]) / 2;
  }

  void follow_rim(int side) {
    const auto nodes = mesh::side_nodes(space_.shape(), space_.degree, side);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const int a = nodes[i], b = nodes[i + 1];
      if (touches(a) && touches(b))
        add({a, a}, {b, b}, true);
      else if (touches(a))
        add({a, a}, {a, b}, true);
      else if (touches(b))
        add({b, a}, {b, b}, true);
    }
  }

  /// Adds a segment. Returns the places of its ends in the reference cell.
  std::array<Eigen::Vector2d, 2> add(const CellEnd& from, const CellEnd& to, bool is_rim) {
    segments_.push_back({.zone = labels_.of_node[static_cast<std::size_t>(node(from.touching))],
                         .is_rim = is_rim,
                         .ends = {named(from), named(to)}});
    std::array places{place(from), place(to)};
    new_ends_.insert(new_ends_.end(), {from, to});
    new_places_.insert(new_places_.end(), places.begin(), places.end());
    return places;
  }

  SegmentEnd named(const CellEnd& end) const {
    const auto sorted = [](GlobalIndex a, GlobalIndex b) { return std::array{std::min(a, b), std::max(a, b)}; };
    const LocalIndex a = node(end.touching), b = node(end.other);
    const algebra::Layout& layout = *space_.layout;
    return {.nodes = sorted(layout.global(a), layout.global(b)),
            .names = sorted(layout.global(representative(space_, a)), layout.global(representative(space_, b))),
            .reach = reach(a, b),
            .point = {}};
  }

  /// The reach of an end between two nodes that hang or are masters of hanging nodes: a multiple of their
  /// distance.
  double reach(LocalIndex a, LocalIndex b) const {
    constexpr double some_more = 2;
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (!is_at_hanging_[i] || !is_at_hanging_[j]) return 0;
    return some_more * (discrete_.points[i].phi - discrete_.points[j].phi).norm();
  }

  const Eigen::Vector2d& reference_point(int i) const {
    return discrete_.shell.tables().nodes[static_cast<std::size_t>(i)];
  }

  /// The end's place in the reference cell: first from the gaps of its two nodes, then on the edge predicted by free
  /// nodes.
  Eigen::Vector2d place(const CellEnd& end) const {
    const Eigen::Vector2d &a = reference_point(end.touching), &b = reference_point(end.other);
    if (end.touching == end.other) return a;
    return edge_near(end, a + (1 - touching_.crossing(node(end.other), node(end.touching))) * (b - a));
  }

  /// The point of the edge that free nodes on the end's side predict near `between`; `between` itself if they predict
  /// none.
  Eigen::Vector2d edge_near(const CellEnd& end, const Eigen::Vector2d& between) const {
    const geometry::Frame frame = frame_at(between);
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << frame.a_cov[0], frame.a_cov[1];
    const auto way = opening_.way_to_edge(node(end.other), search(end, frame, tangents));
    if (!way) return between;
    const Eigen::Vector2d moved = between + tangents.colPivHouseholderQr().solve(*way);
    if (!is_beside_no_border(moved)) return between;
    constexpr double curved = 0.1;  // charts may end or diverge a little outside of their cells
    return (frame_at(moved).phi - frame.phi - *way).norm() <= curved * way->norm() ? moved : between;
  }

  geometry::Frame frame_at(const Eigen::Vector2d& xi) const {
    return discrete_.shell.surface().frame(space_.cells[cell_], xi, false);
  }

  /// Twice the area of the triangle of a side and a point. It is positive inside of the side and 0 on it.
  double inside_of(int side, const Eigen::Vector2d& xi) const {
    const auto corners = mesh::anticlockwise_corners(space_.shape(), side);
    const Eigen::Vector2d a = mesh::corner(space_.shape(), corners[0]), b = mesh::corner(space_.shape(), corners[1]);
    const Eigen::Vector2d along = b - a, way = xi - a;
    return along[0] * way[1] - along[1] * way[0];
  }
  bool is_border(int side) const { return (borders_[cell_] >> side & 1U) != 0; }

  /// Whether the point is at most one distance of nodes outside of the cell, and not outside of a border: the end of
  /// the shell, of a region or of a smooth part.
  bool is_beside_no_border(const Eigen::Vector2d& xi) const {
    for (int side = 0; side < mesh::corner_count(space_.shape()); ++side)
      if (inside_of(side, xi) < (is_border(side) ? -rounding_of_xi : -1.0 / space_.degree)) return false;
    return true;
  }

  EdgeSearch search(const CellEnd& end, const geometry::Frame& frame,
                    const Eigen::Matrix<double, 3, 2>& tangents) const {
    const assembly::NodalPoint &touching = discrete_.points[static_cast<std::size_t>(node(end.touching))],
                               &other = discrete_.points[static_cast<std::size_t>(node(end.other))];
    EdgeSearch search{.from = frame.phi, .axes = {}, .inwards = touching.phi - other.phi};
    const Vector3d &a3 = frame.a3, across = geometry::tangential(search.inwards, a3).normalized();
    search.shear_length = shell::bending_length(shell::section_at(
        discrete_.shell.section(cell_).material, shell::orthonormal_frame(across, a3.cross(across)), other.thickness));
    search.axes.col(0) = frame.a_cov[0].normalized();
    search.axes.col(1) = a3.cross(search.axes.col(0));
    const Eigen::Vector2d &a = reference_point(end.touching), &b = reference_point(end.other);
    for (int side = 0; side < mesh::corner_count(space_.shape()); ++side)
      if (is_border(side) && std::abs(inside_of(side, a)) < rounding_of_xi &&
          std::abs(inside_of(side, b)) < rounding_of_xi)
        search.along = search.axes.transpose() * (tangents * (b - a)).normalized();
    return search;
  }

  /// Height of the touching face above the mid-surface at a point of the cell; 0 at a fold for a face of another side.
  double height(const CellEnd& end, const Eigen::Vector2d& xi) const {
    const double z = gaps_[static_cast<std::size_t>(node(end.touching))].arm,
                 other = gaps_[static_cast<std::size_t>(node(end.other))].arm;
    if (end.touching == end.other || z * other <= 0) return z;
    const Eigen::Vector2d way = reference_point(end.other) - reference_point(end.touching);
    return z + way.dot(xi - reference_point(end.touching)) / way.squaredNorm() * (other - z);
  }

  /// Evaluates shell and displacement at the ends of the segments added in the present cell.
  void place_new_ends() {
    if (new_ends_.empty()) return;
    const fem::Cell& cell = space_.cells[cell_];
    const std::vector<Eigen::Vector2d>& xi = new_places_;
    std::vector<geometry::Frame> frames(xi.size());
    std::vector<double> x(xi.size()), y(xi.size());
    discrete_.shell.surface().frames(cell, xi, frames, false);
    discrete_.shell.surface().positions(cell, xi, x, y);
    const element::CellField moved = discrete_.shell.interpolation().values(
        cell_, element::basis_at(space_.shape(), space_.degree, xi), discrete_.shell.gather(cell_, solution_.y));
    const std::size_t first = segments_.size() - new_ends_.size() / 2;
    for (std::size_t i = 0; i < new_ends_.size(); ++i) {
      const auto row = moved.row(static_cast<Eigen::Index>(i));
      const double z = height(new_ends_[i], xi[i]);
      segments_[first + i / 2].ends[i % 2].point = {
          .x = {x[i], y[i]},
          .place = frames[i].phi + z * frames[i].a3,
          .displacement = row.head<3>().transpose() + z * row.tail<3>().transpose()};
    }
    new_ends_.clear();
    new_places_.clear();
  }

  const assembly::DiscreteShell& discrete_;
  const fem::Space& space_;
  const solution::NodalSolution& solution_;
  const std::vector<obstacle::Gap>& gaps_;
  const TouchingNodes& touching_;
  const ZoneLabels& labels_;
  const GapOpening& opening_;
  std::vector<unsigned> borders_;    ///< sides of each cell on named curves and on the rim, one bit each
  std::vector<char> is_at_hanging_;  ///< 1 if the node hangs or is a master of hanging nodes
  std::size_t cell_ = 0;
  std::vector<Segment> segments_{};
  std::vector<double> areas_;                  // areas of the zones
  std::vector<CellEnd> new_ends_{};            // ends of the last segments, two each
  std::vector<Eigen::Vector2d> new_places_{};  // places of the new ends
};

}  // namespace

ZoneBoundaries zone_boundaries(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                               std::size_t obstacle, const TouchingNodes& touching, const ZoneLabels& labels) {
  if (labels.count == 0) return {};
  const MPI_Comm comm = discrete.space().layout->comm;
  const GapOpening opening(discrete, touching);
  const ZoneBoundaries mine =
      algebra::in_agreement(comm, [&] { return Marching(discrete, solution, obstacle, touching, labels, opening)(); });
  ZoneBoundaries boundaries{.segments = algebra::gathered(mine.segments, comm),
                            .areas = algebra::sums_over_ranks(mine.areas, comm)};
  for (double& area : boundaries.areas)
    area = std::max(area, 0.0);  // along a line, ends may lie on the wrong sides of each other
  return boundaries;
}

}  // namespace plastron::zones
