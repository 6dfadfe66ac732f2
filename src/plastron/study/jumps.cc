#include <plastron/study/jumps.hpp>

#include <plastron/fem/mesh_sequence.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::study {

namespace {

using Eigen::Vector2d;

/// A little inside: what jumps at a side of the cell does no harm.
Vector2d drawn_in(fem::Shape shape, const Vector2d& xi) {
  constexpr double margin = 1e-6;
  const Vector2d centre = fem::centre(shape);
  return centre + (1 - margin) * (xi - centre);
}

}  // namespace

JumpSearch::JumpSearch(const Examined& examined)
    : surface_(*examined.surface), finest_(std::exp2(examined.problem.discretisation.refinements)) {
  constexpr int enough_cells = 256, enough_lines = 1000;
  const Discretisation& d = examined.problem.discretisation;
  fem::MeshSequence meshes(fem::coarse_mesh(examined.problem.domain, d.cells), 1, MPI_COMM_SELF);
  for (int level = 0; level < d.refinements && meshes.space()->global_cells < enough_cells; ++level) meshes.refine({});
  space_ = meshes.space();
  const auto cells = static_cast<double>(space_->global_cells);
  const int n = std::clamp(static_cast<int>(std::sqrt(enough_lines * 4 / cells)), 1, 32);
  for (const Vector2d& p : fem::lattice(d.cells, n))
    for (const Vector2d& step : {Vector2d(1.0 / n, 0), Vector2d(0, 1.0 / n)})
      if (fem::holds(d.cells, p + step, 1e-9)) segments_.push_back({drawn_in(d.cells, p), drawn_in(d.cells, p + step)});
}

std::optional<Jump> JumpSearch::in_cells(const CellFunction& f, double tolerance, Lines on_lines) const {
  for (const fem::Cell& cell : space_->cells)
    for (const Segment& segment : segments_)
      if (const auto jump = on_segment(cell, segment, f, tolerance, on_lines)) return jump;
  return {};
}

std::optional<Jump> JumpSearch::along_boundary(const std::string& name, const CellFunction& f, double tolerance) const {
  constexpr int pieces = 8;
  const auto& names = space_->coarse->boundaries;
  const auto boundary = static_cast<int>(std::ranges::find(names, name) - names.begin());
  for (const fem::BoundaryFace& face : space_->faces) {
    if (face.boundary != boundary) continue;
    const auto at = [&](int k) {
      const double t = 0.5 + (1 - 1e-6) * (static_cast<double>(k) / pieces - 0.5);
      return fem::side_point(space_->shape(), face.side, t);
    };
    for (int k = 0; k < pieces; ++k)
      if (const auto jump = on_segment(space_->cells[face.cell], {at(k), at(k + 1)}, f, tolerance, Lines::allowed))
        return jump;
  }
  return {};
}

std::optional<Jump> JumpSearch::on_segment(const fem::Cell& cell, const Segment& segment, const CellFunction& f,
                                           double tolerance, Lines on_lines) const {
  // No half: f may have a value between both sides exactly there, sign(0) = 0.
  constexpr double ratio = 0.41;
  constexpr int early = 20, steps = 44;  // parts of 3e-5 and 1e-10 of the segment
  Vector2d from = segment.from, to = segment.to;
  Sample at_from = f(cell, from), at_to = f(cell, to);
  double before = 0;
  for (int step = 0; step < steps; ++step) {
    const Vector2d middle = from + ratio * (to - from);
    const Sample at_middle = f(cell, middle);
    if (!at_from.allFinite() || !at_middle.allFinite() || !at_to.allFinite())
      return Jump{position(cell, middle), INFINITY, false};
    // A jump, half of it if `from` or `to` lies on it, leaves at least this much between f and its interpolant.
    const double bend = (at_middle - (1 - ratio) * at_from - ratio * at_to).norm();
    if (bend < ratio / 2 * tolerance) return {};
    if ((at_middle - at_from).norm() > (at_to - at_middle).norm()) {
      to = middle;
      at_to = at_middle;
    } else {
      from = middle;
      at_from = at_middle;
    }
    if (step == early) before = (at_to - at_from).norm();
  }
  const double size = (at_to - at_from).norm();
  // A root shrinks, though slowly.
  if (size < tolerance || size < 0.3 * before) return {};
  if (on_lines == Lines::allowed && is_on_a_mesh_line(cell, from)) return {};
  return Jump{position(cell, from), size, size < 100};
}

bool JumpSearch::is_on_a_mesh_line(const fem::Cell& cell, const Vector2d& xi) const {
  const auto is_whole = [](double t) { return std::abs(t - std::round(t)) < 1e-5; };
  const Vector2d t = finest_ * (cell.corner + cell.size * xi);
  return is_whole(t[0]) || is_whole(t[1]) || (space_->shape() == fem::Shape::triangle && is_whole(t.sum()));
}

Vector2d JumpSearch::position(const fem::Cell& cell, const Vector2d& xi) const {
  Vector2d x;
  surface_.positions(cell, {&xi, 1}, {&x[0], 1}, {&x[1], 1});
  return x;
}

}  // namespace plastron::study
