#include <plastron/zones/touching_nodes.hpp>

#include <plastron/constraints/map.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/solution/contact_faces.hpp>
#include <plastron/zones/sub_cells.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::zones {

namespace {

using algebra::LocalIndex;

/// Solves A x = b in the directions with large eigenvalues of A: neighbours lie on a surface, some on a line.
Vector3d least_solution(const Eigen::Matrix3d& A, const Vector3d& b) {
  constexpr double known = 1e-3;
  const auto modes = geometry::symmetric_eigen(A);
  Vector3d x = Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (modes.values[k] > known * modes.values[2])
      x += modes.vectors.col(k).dot(b) / modes.values[k] * modes.vectors.col(k);
  return x;
}

}  // namespace

LocalIndex representative(const fem::Space& space, LocalIndex node) {
  const constraints::Row* row = space.continuity.find(static_cast<std::size_t>(node));
  return row && row->terms.size() == 1 ? row->terms.front().node : node;
}

TouchingNodes::TouchingNodes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                             std::size_t obstacle) {
  const algebra::Vector touching = solution::contact_faces(discrete, solution).touching;
  const auto count = discrete.points.size(), block = static_cast<std::size_t>(touching.block());
  for (std::size_t i = 0; i < count; ++i) {
    const double gap = discrete.nodal_gap(obstacle, i, solution.y);
    inside_.push_back(touching.local()[i * block + obstacle] != 0 ? 1 : 0);
    root_.push_back(std::sqrt(std::max(gap - discrete.state.lift(i, obstacle), 0.0)));
    place_.push_back(discrete.points[i].phi);
  }
  judge_nodes_without_bound(discrete);
  take_in_lifted_nodes(discrete);
  fit_slopes(discrete);
  continue_roots(discrete);
}

void TouchingNodes::judge_nodes_without_bound(const assembly::DiscreteShell& discrete) {
  constexpr int block = 3;  // neighbours that touch, free ones, the sum of their roots
  constexpr double closed = 0.1;
  const fem::Space& space = discrete.space();
  if (space.shape() != mesh::Shape::triangle || space.degree != 2) return;
  const auto has_bound = [&](LocalIndex node) {  // weights of constrained nodes were added to their masters
    return discrete.points[static_cast<std::size_t>(representative(space, node))].side_weight > 0;
  };
  algebra::Vector sums(space.layout, block);
  for_neighbours(space, [&](LocalIndex a, LocalIndex b) {
    if (has_bound(a) || !has_bound(b)) return;
    double* s = sums.local().data() + static_cast<std::size_t>(a) * block;
    s[(*this)[b] ? 0 : 1] += 1;
    if (!(*this)[b]) s[2] += root_[static_cast<std::size_t>(b)];
  });
  make_whole(space, sums);
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    const double* s = sums.local().data() + i * block;
    if (has_bound(static_cast<LocalIndex>(i))) continue;
    const bool is_closed = s[0] == s[1] && s[1] * root_[i] <= closed * s[2];
    inside_[i] = s[0] > s[1] || is_closed ? 1 : 0;
  }
}

void TouchingNodes::take_in_lifted_nodes(const assembly::DiscreteShell& discrete) {
  constexpr int block = 2;  // neighbours, free ones
  constexpr double most =
      0.21;  // part of the neighbours, across a side counted twice: one of eight, or two across corners
  const fem::Space& space = discrete.space();
  for (int pass = 0; pass < 2; ++pass) {
    algebra::Vector sums(space.layout, block);
    for_neighbours(space, [&](LocalIndex a, LocalIndex b) {
      double* s = sums.local().data() + static_cast<std::size_t>(a) * block;
      s[0] += 1;
      s[1] += (*this)[b] ? 0 : 1;
    });
    make_whole(space, sums);
    for (std::size_t i = 0; i < inside_.size(); ++i) {
      const double* s = sums.local().data() + i * block;
      if (std::abs(s[1]) <= most * s[0]) inside_[i] = 1;  // weights at hanging nodes may be negative
    }
  }
}

void TouchingNodes::fit_slopes(const assembly::DiscreteShell& discrete) {
  constexpr int block = 9;  // A (11 12 13 22 23 33), b
  const fem::Space& space = discrete.space();
  algebra::Vector sums(space.layout, block);
  for_neighbours(space, [&](LocalIndex a, LocalIndex b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (inside_[i] || inside_[j]) return;
    const Vector3d d = (place_[j] - place_[i]).normalized();
    const double slope = (root_[j] - root_[i]) / (place_[j] - place_[i]).norm();
    double* s = sums.local().data() + i * block;
    int at = 0;
    for (int k = 0; k < 3; ++k)
      for (int l = k; l < 3; ++l) s[at++] += d[k] * d[l];
    for (int k = 0; k < 3; ++k) s[6 + k] += slope * d[k];
  });
  make_whole(space, sums);
  slope_.reserve(inside_.size());
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    const double* s = sums.local().data() + i * block;
    Eigen::Matrix3d A;
    A << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
    slope_.push_back(s[0] + s[3] + s[5] > 0 ? least_solution(A, {s[6], s[7], s[8]}) : Vector3d::Zero());
  }
}

void TouchingNodes::continue_roots(const assembly::DiscreteShell& discrete) {
  constexpr int block = 2;  // free neighbours, the sum of their continued roots
  const fem::Space& space = discrete.space();
  algebra::Vector sums(space.layout, block);
  for_neighbours(space, [&](LocalIndex a, LocalIndex b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (!inside_[i] || inside_[j]) return;
    sums.local()[i * block] += 1;
    sums.local()[i * block + 1] += root_[j] + slope_[j].dot(place_[i] - place_[j]);
  });
  make_whole(space, sums);
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    const double* s = sums.local().data() + i * block;
    if (inside_[i]) root_[i] = s[0] > 0 ? std::min(s[1] / s[0], 0.0) : 0;
  }
}

double TouchingNodes::crossing(LocalIndex free, LocalIndex touching) const {
  const double outside = root_[static_cast<std::size_t>(free)], inside = root_[static_cast<std::size_t>(touching)];
  return outside > inside ? outside / (outside - inside) : 1;
}

}  // namespace plastron::zones
