#include <plastron/obstacle/triangle_tree.hpp>

#include <algorithm>
#include <limits>

namespace plastron::obstacle {

namespace {

using geometry::Vector3d;

double squared_distance_to_side(const Vector3d& from_p, const Vector3d& along) {
  const double s = std::clamp(from_p.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (from_p - s * along).squaredNorm();
}

double squared_distance(const Vector3d& X, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = b - a, v = c - a, w = X - a, n = u.cross(v);
  const double nn = n.squaredNorm();
  const double beyond_c = u.cross(w).dot(n), beyond_b = w.cross(v).dot(n);
  if (beyond_c >= 0 && beyond_b >= 0 && beyond_b + beyond_c <= nn) {
    const double off = w.dot(n);
    return off * off / nn;
  }
  return std::min(
      {squared_distance_to_side(w, u), squared_distance_to_side(w, v), squared_distance_to_side(X - b, c - b)});
}

}  // namespace

struct TriangleTree::Search {
  const Vector3d& X;
  double least = std::numeric_limits<double>::infinity();
  int triangle = 0;
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  leaves_.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    leaves_.push_back({mesh.points[corner[0]], mesh.points[corner[1]], mesh.points[corner[2]], static_cast<int>(t)});
  }
  nodes_.reserve(leaves_.size());
  nodes_.emplace_back();
  divide(0, 0, static_cast<int>(leaves_.size()));
}

void TriangleTree::divide(int node, int first, int last) {
  constexpr int most_in_leaf = 4;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{Vector3d::Constant(infinity), Vector3d::Constant(-infinity)}, middles = box;
  for (int i = first; i < last; ++i) {
    const auto& [a, b, c, triangle] = leaves_[i];
    box.low = box.low.cwiseMin(a).cwiseMin(b).cwiseMin(c);
    box.high = box.high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
    middles.low = middles.low.cwiseMin(a + b + c);
    middles.high = middles.high.cwiseMax(a + b + c);
  }
  if (last - first <= most_in_leaf) {
    nodes_[node] = {box, first, last - first};
    return;
  }
  int axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(leaves_.begin() + first, leaves_.begin() + half, leaves_.begin() + last,
                   [&](const auto& p, const auto& q) {
                     return p.a[axis] + p.b[axis] + p.c[axis] < q.a[axis] + q.b[axis] + q.c[axis];
                   });
  const int child = static_cast<int>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node] = {box, child, 0};
  divide(child, first, half);
  divide(child + 1, half, last);
}

void TriangleTree::search(int node, Search& search) const {
  const Node& at = nodes_[node];
  for (int i = at.first; i < at.first + at.count; ++i) {
    const double d = squared_distance(search.X, leaves_[i].a, leaves_[i].b, leaves_[i].c);
    if (d < search.least) search.least = d, search.triangle = leaves_[i].triangle;
  }
  if (at.count > 0) return;
  const double left = nodes_[at.first].box.squared_distance(search.X),
               right = nodes_[at.first + 1].box.squared_distance(search.X);
  const int nearer = right < left ? 1 : 0;
  if (std::min(left, right) < search.least) this->search(at.first + nearer, search);
  if (std::max(left, right) < search.least) this->search(at.first + 1 - nearer, search);
}

int TriangleTree::nearest(const Vector3d& X) const {
  Search all{X};
  search(0, all);
  return all.triangle;
}

}  // namespace plastron::obstacle
