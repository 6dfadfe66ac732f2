#include <plastron/examination/jumps.hpp>

#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::examination {

namespace {

using Eigen::Vector2d;

/// Returns a point slightly inside the cell: a jump at a side of the cell is harmless.
Vector2d drawn_in(mesh::Shape shape, const Vector2d& xi) {
  constexpr double margin = 1e-6;
  const Vector2d centre = mesh::centre(shape);
  return centre + (1 - margin) * (xi - centre);
}

/// A segment in a cell with three samples. The second one is not in the middle: exactly on a jump, f may have a value
/// between both sides, as sign(0) = 0.
struct Part {
  static constexpr double ratio = 0.41;
  Vector2d from, between, to;
  Sample at_from, at_between, at_to;

  /// Deviation of f from linear. A smooth f leaves h^2; a jump J leaves at least 0.41 J, or half of it at an
  /// end of the segment. Differences alone would hide a small jump where f rises steeply.
  double bend() const { return (at_between - (1 - ratio) * at_from - ratio * at_to).norm(); }
};

/// Divides a segment towards the part that does not become smooth.
class Descent {
 public:
  struct Found {
    Vector2d xi;
    double size = 0;
    bool is_bounded = true;
  };

  Descent(const fem::Cell& cell, const CellFunction& f, double tolerance)
      : cell_(cell), f_(f), least_bend_(Part::ratio / 2 * tolerance), tolerance_(tolerance) {}

  std::optional<Found> operator()(const Vector2d& from, const Sample& at_from, const Vector2d& to,
                                  const Sample& at_to) {
    return search(part(from, at_from, to, at_to), 0, 0);
  }

 private:
  static constexpr int early = 20, steps = 44;  // parts of 3e-5 and 1e-10 of the segment

  Part part(const Vector2d& a, const Sample& at_a, const Vector2d& b, const Sample& at_b) {
    const Vector2d between = a + Part::ratio * (b - a);
    return Part{a, between, b, at_a, f_(cell_, between), at_b};
  }

  /// Searches a part. `before`: the change over the part of step `early`.
  std::optional<Found> search(const Part& p, int step, double before) {
    if (!std::isfinite(p.bend())) return Found{p.between, INFINITY, false};
    if (p.bend() < least_bend_) return {};
    const double change = (p.at_to - p.at_from).norm();
    if (step == early) before = change;
    if (step == steps) return jump(p, change, before);
    const Part first = part(p.from, p.at_from, p.between, p.at_between);
    const Part second = part(p.between, p.at_between, p.to, p.at_to);
    return search(first.bend() < second.bend() ? second : first, step + 1, before);
  }

  std::optional<Found> jump(const Part& p, double change, double before) const {
    // A root decreases, though slowly; a pole grows.
    if (change < tolerance_ || change < 0.3 * before) return {};
    return Found{p.from, change, change < 3 * before};
  }

  const fem::Cell& cell_;
  const CellFunction& f_;
  double least_bend_, tolerance_;
};

}  // namespace

JumpSearch::JumpSearch(const Examined& examined)
    : surface_(*examined.surface), finest_(std::exp2(examined.problem.discretisation.refinements)) {
  constexpr int enough_cells = 256, enough_lines = 1000;
  const problem::Discretisation& d = examined.problem.discretisation;
  fem::MeshSequence meshes(meshing::start_mesh(examined.problem).coarse, 1, MPI_COMM_SELF);
  for (int level = 0; level < d.refinements && meshes.space()->global_cells < enough_cells; ++level) meshes.refine({});
  space_ = meshes.space();
  const auto cells = static_cast<double>(space_->global_cells);
  const int n = std::clamp(static_cast<int>(std::sqrt(enough_lines * 4 / cells)), 1, 32);
  const std::vector<Vector2d> lattice = mesh::lattice(d.cells, n);
  for (const Vector2d& p : lattice) points_.push_back(drawn_in(d.cells, p));
  for (std::size_t i = 0; i < lattice.size(); ++i)
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      const Vector2d step = n * (lattice[k] - lattice[i]);
      if ((step - Vector2d(1, 0)).norm() < 1e-6 || (step - Vector2d(0, 1)).norm() < 1e-6) segments_.emplace_back(i, k);
    }
}

std::optional<Jump> JumpSearch::in_cells(const CellFunction& f, double tolerance, Lines on_lines) const {
  std::vector<Sample> values(points_.size());
  for (const fem::Cell& cell : space_->cells) {
    for (std::size_t i = 0; i < points_.size(); ++i) values[i] = f(cell, points_[i]);
    for (const auto& [i, k] : segments_)
      if (auto jump = between(cell, {points_[i], values[i]}, {points_[k], values[k]}, f, tolerance, on_lines))
        return jump;
  }
  return {};
}

std::optional<Jump> JumpSearch::along_lines(const CellFunction& f, double tolerance, Lines on_lines) const {
  constexpr int enough_samples = 100'000, most = 2000;
  constexpr std::array offsets{0.29, 0.71};
  constexpr int lines = 2 * static_cast<int>(offsets.size());
  const int pieces = std::clamp(enough_samples / (lines * static_cast<int>(space_->cells.size())), 1, most);
  for (const fem::Cell& cell : space_->cells)
    for (const double offset : offsets)
      for (int along = 0; along < 2; ++along) {
        const double length = space_->shape() == mesh::Shape::triangle ? 1 - offset : 1;
        const auto end = [&](int k) {
          Vector2d xi(offset, offset);
          xi[along] = length * k / pieces;
          xi = drawn_in(space_->shape(), xi);
          return End{xi, f(cell, xi)};
        };
        End from = end(0);
        for (int k = 1; k <= pieces; ++k) {
          End to = end(k);
          if (auto jump = between(cell, from, to, f, tolerance, on_lines)) return jump;
          from = std::move(to);
        }
      }
  return {};
}

std::optional<Jump> JumpSearch::along_boundary(const std::string& name, const CellFunction& f, double tolerance) const {
  constexpr int pieces = 8;
  const auto& names = space_->coarse->boundaries;
  const auto boundary = static_cast<int>(std::ranges::find(names, name) - names.begin());
  for (const fem::BoundarySide& edge : space_->sides) {
    if (edge.boundary != boundary) continue;
    const fem::Cell& cell = space_->cells[edge.cell];
    const auto end = [&](int k) {
      const double t = 0.5 + (1 - 1e-6) * (static_cast<double>(k) / pieces - 0.5);
      const Vector2d xi = mesh::side_point(space_->shape(), edge.side, t);
      return End{xi, f(cell, xi)};
    };
    for (int k = 0; k < pieces; ++k)
      if (auto jump = between(cell, end(k), end(k + 1), f, tolerance, Lines::at_corners)) return jump;
  }
  return {};
}

std::optional<Jump> JumpSearch::between(const fem::Cell& cell, const End& from, const End& to, const CellFunction& f,
                                        double tolerance, Lines on_lines) const {
  const auto found = Descent(cell, f, tolerance)(from.xi, from.value, to.xi, to.value);
  if (!found || (on_lines != Lines::forbidden && is_allowed(cell, found->xi, on_lines))) return {};
  return Jump{position(cell, found->xi), found->size, found->is_bounded};
}

bool JumpSearch::is_allowed(const fem::Cell& cell, const Vector2d& xi, Lines on_lines) const {
  const auto is_whole = [](double t) { return std::abs(t - std::round(t)) < 1e-5; };
  const Vector2d t = finest_ * (cell.corner + cell.size * xi);
  if (on_lines == Lines::at_corners) return is_whole(t[0]) && is_whole(t[1]);
  return is_whole(t[0]) || is_whole(t[1]) || (space_->shape() == mesh::Shape::triangle && is_whole(t.sum()));
}

Vector2d JumpSearch::position(const fem::Cell& cell, const Vector2d& xi) const {
  Vector2d x;
  surface_.positions(cell, {&xi, 1}, {&x[0], 1}, {&x[1], 1});
  return x;
}

}  // namespace plastron::examination
