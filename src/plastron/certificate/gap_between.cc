#include <plastron/certificate/gap_between.hpp>
#include <plastron/certificate/piece.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <limits>

namespace plastron::certificate {

namespace {

using fem::Vector2d;

/// Depth that the search may overlook, as a part of the thickness: half of the depth that counts as missed contact.
constexpr double overlooked_depth = 5e-3;
/// The search in a cell stops after this number of points: along sharp edges in contact only the smallest size would
/// end it.
constexpr std::size_t most_points = 4096;

/// The deformed shell at points of one cell at a time.
class CellPoints {
 public:
  CellPoints(const assembly::DiscreteShell& discrete, const algebra::Vector& y) : discrete_(discrete), y_(y) {
    for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) now_.push_back(discrete.obstacles.now(k));
  }

  /// Looks at points of a cell, whose gaps to an obstacle are asked next.
  void look_at(std::size_t cell, std::size_t obstacle, const element::BasisAt& basis) {
    look_at(cell, basis);
    prepare(obstacle);
  }
  void look_at(std::size_t cell, const element::BasisAt& basis) {
    const std::size_t count = basis.xi.size();
    frames_.resize(count);
    for (auto* values : {&px_, &py_, &thickness_}) values->resize(count);
    const energy::ShellOperator& shell = discrete_.shell;
    shell.surface().frames(shell.space().cells[cell], basis.xi, frames_, false);
    shell.surface().positions(shell.space().cells[cell], basis.xi, px_, py_);
    shell.surface().evaluate(shell.section(cell).thickness, shell.space().cells[cell], basis.xi, thickness_);
    values_ = shell.interpolation().values(cell, basis, shell.gather(cell, y_));
  }

  std::size_t size() const { return frames_.size(); }
  Vector2d x(std::size_t p) const { return {px_[p], py_[p]}; }
  double thickness(std::size_t p) const { return thickness_[p]; }
  /// The gap at a point.
  obstacle::FaceGap gap(std::size_t obstacle, std::size_t p) const {
    return discrete_.obstacles.true_gap(obstacle, now_[obstacle], point(p));
  }
  /// The largest distance from point p to points of the cell whose coordinates differ by at most `half`, with a
  /// reserve for strains and curvature.
  double reach(std::size_t p, double half) const {
    constexpr double reserve = 1.25;
    return reserve * half * (frames_[p].a_cov[0].norm() + frames_[p].a_cov[1].norm());
  }

  /// Returns the obstacles near each owned cell.
  std::vector<std::vector<std::size_t>> near_obstacles() const {
    std::vector<std::vector<std::size_t>> near(discrete_.space().owned_cells);
    for (std::size_t k = 0; k < now_.size(); ++k) {
      if (now_[k].has_bed()) continue;  // its surface gives way, between nodes, too
      discrete_.obstacles.prepare_gaps(body(k), near.size(),
                                       [&](std::size_t c) { return undeformed_if_linear(first_node(c)); });
      for (std::size_t c = 0; c < near.size(); ++c)
        if (is_near(c, k)) near[c].push_back(k);
    }
    return near;
  }

 private:
  obstacle::ShellPoint point(std::size_t p) const {
    return discrete_.shell_point(frames_[p].phi, frames_[p].a3, thickness_[p],
                                 values_.row(static_cast<Eigen::Index>(p)).transpose());
  }
  obstacle::ShellPoint first_node(std::size_t cell) const {
    const auto first = static_cast<std::size_t>(discrete_.space().nodes(cell)[0]);
    const assembly::NodalPoint& at = discrete_.points[first];
    return discrete_.shell_point(at.phi, at.a3, at.thickness, assembly::node_values(y_, first));
  }

  /// Whether a cell may be near an obstacle, judged at its first node: the distance changes by at most the way
  /// travelled.
  bool is_near(std::size_t cell, std::size_t obstacle) const {
    constexpr double reserve = 1.5;  // reserve for bulges between nodes
    const auto nodes = discrete_.space().nodes(cell);
    const auto first = static_cast<std::size_t>(nodes[0]);
    const auto displaced = [&](std::size_t i) {
      return Vector3d(discrete_.points[i].phi + assembly::node_values(y_, i).head<3>());
    };
    double radius = 0;
    for (const algebra::LocalIndex i : nodes)
      radius = std::max(radius, (displaced(static_cast<std::size_t>(i)) - displaced(first)).norm());
    return discrete_.obstacles.true_gap(obstacle, now_[obstacle], first_node(cell)).clearance <= reserve * radius;
  }

  /// The obstacle and the point for which true_gap() computes distances.
  const obstacle::Obstacle& body(std::size_t obstacle) const {
    return discrete_.obstacles.are_linear ? discrete_.obstacles.all[obstacle] : now_[obstacle];
  }
  obstacle::ShellPoint undeformed_if_linear(obstacle::ShellPoint at) const {
    if (discrete_.obstacles.are_linear) at.u = at.r = Vector3d::Zero();
    return at;
  }
  void prepare(std::size_t obstacle) const {
    if (!now_[obstacle].is_searched()) return;
    discrete_.obstacles.prepare_gaps(body(obstacle), size(),
                                     [&](std::size_t p) { return undeformed_if_linear(point(p)); });
  }

  const assembly::DiscreteShell& discrete_;
  const algebra::Vector& y_;
  std::vector<obstacle::Obstacle> now_{};
  std::vector<geometry::Frame> frames_{};
  std::vector<double> px_{}, py_{}, thickness_{};
  element::CellField values_{};
};

/// Intervals per side: twice as fine as the nodes, four times as fine for degree 1.
int intervals_of(int degree) { return std::max(4, 2 * degree); }

Vector2d put_into(mesh::Shape shape, Vector2d xi) {
  xi = xi.cwiseMax(0).cwiseMin(1);
  if (shape == mesh::Shape::triangle && xi.sum() > 1) xi = (xi.array() - (xi.sum() - 1) / 2).max(0).matrix();
  return xi;
}

/// Search in one cell for one obstacle.
class GapSearch {
 public:
  GapSearch(const fem::Space& space, std::size_t cell, std::size_t obstacle)
      : space_(space), best_{cell, obstacle, std::numeric_limits<double>::infinity(), Vector2d::Zero()} {}

  /// Evaluates the gaps at the pieces' centres, where `points` are.
  void note(const CellPoints& points, std::span<const Piece> pieces) {
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const obstacle::FaceGap gap = points.gap(best_.obstacle, p);
      if (gap.distance < best_.gap) {
        best_.gap = gap.distance;
        best_.x = points.x(p);
      }
      if (!is_clear(gap, points.reach(p, pieces[p].half), overlooked_depth * points.thickness(p)))
        open_.push_back(pieces[p]);
    }
    seen_ += pieces.size();
  }

  CellGap finish(CellPoints& points) {
    while (!open_.empty() && seen_ < most_points) {
      const std::vector<Piece> pieces = divided();
      std::vector<Vector2d> xi;
      xi.reserve(pieces.size());
      for (const Piece& piece : pieces) xi.push_back(piece.centre);
      points.look_at(best_.cell, best_.obstacle, element::basis_at(space_.shape(), space_.degree, xi));
      note(points, pieces);
    }
    return best_;
  }

 private:
  /// Whether no face in the piece is deeper than `tolerance` unless the centre is too. Either the obstacle is farther
  /// than the piece reaches, or its rounding is wide: a cap of that depth is as wide as the piece.
  static bool is_clear(const obstacle::FaceGap& gap, double reach, double tolerance) {
    return gap.clearance >= reach || reach <= tolerance || reach * reach <= 2 * tolerance * gap.roundness;
  }

  std::vector<Piece> divided() {
    std::vector<Piece> pieces;
    for (const Piece& piece : open_)
      for (const double i : {-0.5, 0.5})
        for (const double j : {-0.5, 0.5})
          pieces.push_back({put_into(space_.shape(), piece.centre + piece.half * Vector2d(i, j)), piece.half / 2});
    open_.clear();
    return pieces;
  }

  const fem::Space& space_;
  CellGap best_;
  std::vector<Piece> open_{};
  std::size_t seen_ = 0;
};

}  // namespace

void visit_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                const std::function<void(std::size_t cell, std::size_t obstacle, const GapsAt&)>& visit) {
  CellPoints points(discrete, y);
  const auto near = points.near_obstacles();
  for (std::size_t c = 0; c < near.size(); ++c)
    for (const std::size_t k : near[c])
      visit(c, k, [&](const element::BasisAt& at) {
        points.look_at(c, k, at);
        std::vector<double> gaps(at.xi.size());
        for (std::size_t p = 0; p < gaps.size(); ++p) gaps[p] = points.gap(k, p).distance;
        return gaps;
      });
}

std::vector<CellGap> searched_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const fem::Space& space = discrete.space();
  const int intervals = intervals_of(space.degree);
  const element::BasisAt basis =
      element::basis_at(space.shape(), space.degree, mesh::lattice(space.shape(), intervals));
  std::vector<Piece> lattice;
  for (const Vector2d& xi : basis.xi) lattice.push_back({xi, 0.5 / intervals});
  std::vector<CellGap> all;
  CellPoints points(discrete, y);
  const auto near = points.near_obstacles();
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    for (const std::size_t k : near[c]) {
      points.look_at(c, k, basis);
      GapSearch search(space, c, k);
      search.note(points, lattice);
      all.push_back(search.finish(points));
    }
  return all;
}

double min_gap_on_lattice(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals) {
  if (discrete.obstacles.empty()) return std::numeric_limits<double>::infinity();
  const MPI_Comm comm = discrete.space().layout->comm;
  const fem::Space& space = discrete.space();
  const element::BasisAt lattice =
      element::basis_at(space.shape(), space.degree, mesh::lattice(space.shape(), intervals));
  double smallest = std::numeric_limits<double>::infinity();
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
    visit_gaps(discrete, y, [&](std::size_t, std::size_t, const GapsAt& gaps_at) {
      smallest = std::min(smallest, std::ranges::min(gaps_at(lattice)));
    });
  });
  return algebra::min_over_ranks(smallest, comm);
}

}  // namespace plastron::certificate
