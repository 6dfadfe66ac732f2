#include <plastron/recovery/patches.hpp>

#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace plastron::recovery {

namespace {

/// 1 at the nodes that are a corner of some cell, on every rank that has them (collective).
algebra::Vector corner_marks(const fem::Space& space, const std::array<std::size_t, 4>& corner_nodes) {
  algebra::Vector marks(space.layout, 1);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (int k = 0; k < mesh::corner_count(space.shape()); ++k)
      marks.local()[static_cast<std::size_t>(space.nodes(cell)[corner_nodes[static_cast<std::size_t>(k)]])] = 1;
  marks.accumulate_ghosts();
  marks.update_ghosts();
  return marks;
}

}  // namespace

Vertices::Vertices(const fem::Space& space) {
  const auto k = static_cast<std::size_t>(space.degree);
  if (space.shape() == mesh::Shape::quadrilateral)
    corner_nodes_ = {0, k, k * (k + 1), (k + 1) * (k + 1) - 1};
  else
    corner_nodes_ = {0, k, (k + 1) * (k + 2) / 2 - 1, 0};
  algebra::Vector number = corner_marks(space, corner_nodes_);
  const auto owned_nodes = static_cast<std::size_t>(space.layout->owned);
  algebra::Distribution nodes{.comm = space.layout->comm};
  vertex_of_node_.assign(number.local().size(), -1);
  for (std::size_t node = 0; node < owned_nodes; ++node)
    if (number.local()[node] > 0) vertex_of_node_[node] = nodes.owned++;
  const auto count = static_cast<std::int64_t>(nodes.owned);
  MPI_Exscan(&count, &nodes.first, 1, MPI_INT64_T, MPI_SUM, nodes.comm);
  nodes.global_size = algebra::sum_over_ranks(count, nodes.comm);
  // Exchanges global numbers of the vertices for ghosts. They are increased by one, so that 0 means none.
  for (std::size_t node = 0; node < owned_nodes; ++node)
    number.local()[node] = vertex_of_node_[node] < 0 ? 0 : static_cast<double>(nodes.first + vertex_of_node_[node] + 1);
  number.update_ghosts();
  for (std::size_t node = owned_nodes; node < vertex_of_node_.size(); ++node)
    if (number.local()[node] > 0) {
      vertex_of_node_[node] = nodes.local_size();
      nodes.ghosts.push_back(static_cast<algebra::GlobalIndex>(number.local()[node]) - 1);
    }
  layout_ = std::make_shared<const algebra::Layout>(std::move(nodes));
}

namespace {

/// Cells meet smoothly if the norm of the sum of their unit normals exceeds this times their number: angles below
/// 3e-3.
constexpr double smooth_sum = 1 - 1e-6;
/// A patch includes only points whose normals have at least this cosine with the normal of its vertex.
constexpr double least_cosine = 0.5;
/// Limit of the ratio of least to largest eigenvalue of the normal equations. Below it points do not determine a
/// polynomial. Patches of four quadrilaterals have 1e-3 to 1e-2; patches without points in one direction have only
/// rounding.
constexpr double least_eigenvalue = 1e-5;

// Sums over the cells at a vertex, from which its plane is computed.
enum Sum {
  cells,
  edges,
  curves,
  region,
  region_square,
  normal,
  extent = normal + 3,
  mean,
  moment = mean + 3,
  sums = moment + 6
};

/// Mean of the points relative to the vertex.
Vector3d mean_of(std::span<const double> sum) {
  return Vector3d(sum[mean], sum[mean + 1], sum[mean + 2]) / sum[extent];
}

/// Second moment of the points about their mean.
Eigen::Matrix3d moment_of(std::span<const double> sum) {
  const double* m = sum.data() + moment;
  Eigen::Matrix3d matrix;
  matrix << m[0], m[3], m[5], m[3], m[1], m[4], m[5], m[4], m[2];
  const Vector3d middle = mean_of(sum);
  return matrix / sum[extent] - middle * middle.transpose();
}

/// Tangent plane of a vertex from the sum of its cells' normals, with two unit vectors that are the same on every
/// rank.
struct TangentPlane {
  Vector3d a3, any, other;

  explicit TangentPlane(std::span<const double> sum)
      : a3(Vector3d(sum[normal], sum[normal + 1], sum[normal + 2]).normalized()),
        any(a3.unitOrthogonal()),
        other(a3.cross(any)) {}
  Eigen::Vector2d components(const Vector3d& v) const { return {v.dot(any), v.dot(other)}; }
  SurfaceAxes axes() const { return {any, other, a3}; }
};

/// Maps lengths in the tangent plane so that the patch becomes the square (-1, 1)^2, turned by some angle. Cells may
/// be oblique and thin at once; polynomials along other directions than theirs would not be determined. Zero if the
/// patch has no extent.
Eigen::Matrix2d to_turned_square(std::span<const double> sum, const TangentPlane& plane) {
  const Eigen::Matrix3d moments = moment_of(sum);
  Eigen::Matrix<double, 3, 2> directions;
  directions << plane.any, plane.other;
  // Assumes evenly spread points.
  const Eigen::LLT<Eigen::Matrix2d> root(3 * directions.transpose() * moments * directions);
  if (root.info() != Eigen::Success) return Eigen::Matrix2d::Zero();
  return root.matrixL().solve(Eigen::Matrix2d::Identity());
}

/// The corners at the other ends of a corner's two sides.
std::array<int, 2> neighbours(mesh::Shape shape, int corner) {
  if (shape == mesh::Shape::quadrilateral) return {corner ^ 1, corner ^ 2};
  return {(corner + 1) % 3, (corner + 2) % 3};
}

/// Adds the points of a cell. A point's weight is its part of the cell's area, so that a thin row beside wide cells
/// does not change the patch's extent.
void add_points(const Vector3d& vertex, const CellResultants& cell, double area, std::span<double> sum) {
  const double weight = area / static_cast<double>(cell.position.size());
  for (const Vector3d& position : cell.position) {
    const Vector3d d = position - vertex;
    const std::array products{d[0] * d[0], d[1] * d[1], d[2] * d[2], d[0] * d[1], d[1] * d[2], d[2] * d[0]};
    sum[extent] += weight;
    for (std::size_t k = 0; k < 3; ++k) sum[mean + k] += weight * d[static_cast<Eigen::Index>(k)];
    for (std::size_t k = 0; k < products.size(); ++k) sum[moment + k] += weight * products[k];
  }
}

}  // namespace

Patches::Patches(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells, int degree)
    : space_(discrete.space()),
      corners_(mesh::corner_count(space_.shape())),
      degree_(degree),
      terms_(Eigen::Index{degree + 1} * (degree + 2) / 2),
      vertices_(space_),
      candidates_(candidates()) {
  if (degree > most_degree)
    throw std::invalid_argument("patches of degree " + std::to_string(degree) + ": " + std::to_string(most_degree) +
                                " is the most");
  find_planes(discrete, cells);
  decompose(normal_matrices(cells));
}

// Computes `frames` at the corners of a cell.
void Patches::corner_frames(const assembly::DiscreteShell& discrete, std::size_t cell,
                            std::vector<geometry::Frame>& frames) const {
  frames.resize(static_cast<std::size_t>(corners_));
  std::vector<Eigen::Vector2d> xi(frames.size());
  for (int k = 0; k < corners_; ++k) xi[static_cast<std::size_t>(k)] = mesh::corner(space_.shape(), k);
  discrete.shell.surface().frames(space_.cells[cell], xi, frames, false);
}

algebra::Vector Patches::sums_round_vertices(const assembly::DiscreteShell& discrete,
                                             const std::vector<CellResultants>& cells) const {
  algebra::Vector all(vertices_.layout(), Sum::sums);
  std::vector<geometry::Frame> frames;
  for (std::size_t cell = 0; cell < space_.owned_cells; ++cell) {
    corner_frames(discrete, cell, frames);
    const int region = space_.coarse->cells[static_cast<std::size_t>(space_.cells[cell].coarse)].region;
    const double area = discrete.shell.area(cell);
    for (int k = 0; k < corners_; ++k) {
      const auto sum = all.at(vertex(cell, k));
      const geometry::Frame& frame = frames[static_cast<std::size_t>(k)];
      const Vector3d a3 = frame.a3.normalized();
      sum[Sum::cells] += 1;
      sum[Sum::region] += region;
      sum[Sum::region_square] += double{1} * region * region;
      for (std::size_t d = 0; d < 3; ++d) sum[Sum::normal + d] += a3[static_cast<Eigen::Index>(d)];
      add_points(frame.phi, cells[cell], area, sum);
    }
  }
  for (const fem::BoundarySide& side : space_.sides)
    if (side.cell < space_.owned_cells)
      for (const int corner : mesh::side_corners(space_.shape(), side.side))
        all.at(vertex(side.cell, corner))[side.is_inner ? Sum::curves : Sum::edges] += 1;
  all.accumulate_ghosts();
  all.update_ghosts();
  return all;
}

/// Sets the planes' positions at their vertices. Returns the sums of cosine and sine of four times the edges' angles
/// in the turned square.
algebra::Vector Patches::place(const assembly::DiscreteShell& discrete, const algebra::Vector& sums) {
  algebra::Vector turns(vertices_.layout(), 2);
  std::vector<geometry::Frame> frames;
  for (std::size_t cell = 0; cell < space_.owned_cells; ++cell) {
    corner_frames(discrete, cell, frames);
    for (int k = 0; k < corners_; ++k) {
      const algebra::LocalIndex at = vertex(cell, k);
      const Vector3d& here = frames[static_cast<std::size_t>(k)].phi;
      const TangentPlane plane(sums.at(at));
      const Eigen::Matrix2d to_square = to_turned_square(sums.at(at), plane);
      for (const int other : neighbours(space_.shape(), k)) {
        const Eigen::Vector2d edge = to_square * plane.components(frames[static_cast<std::size_t>(other)].phi - here);
        const double angle = 4 * std::atan2(edge[1], edge[0]);
        turns.at(at)[0] += std::cos(angle);
        turns.at(at)[1] += std::sin(angle);
      }
      planes_[static_cast<std::size_t>(at)].position = here;
    }
  }
  turns.accumulate_ghosts();
  turns.update_ghosts();
  return turns;
}

void Patches::find_planes(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells) {
  planes_.resize(static_cast<std::size_t>(vertices_.layout()->local_size()));
  const algebra::Vector sums = sums_round_vertices(discrete, cells), turns = place(discrete, sums);
  for (algebra::LocalIndex v = 0; v < vertices_.layout()->local_size(); ++v)
    set_plane(v, sums.at(v), std::atan2(turns.at(v)[1], turns.at(v)[0]) / 4);
}

// The square's sides follow the cells' edges as closely as one cross can: polynomials of two degrees require this.
// The corners of a square turned by 45 degrees would lie far outside the region where the basis is well conditioned.
void Patches::set_plane(algebra::LocalIndex vertex, std::span<const double> sum, double angle) {
  const double count = sum[Sum::cells];
  const Vector3d normal(sum[Sum::normal], sum[Sum::normal + 1], sum[Sum::normal + 2]);
  const bool one_region = sum[Sum::region_square] * count - sum[Sum::region] * sum[Sum::region] < 0.5;
  Plane& plane = planes_[static_cast<std::size_t>(vertex)];
  if (count < 2 || sum[Sum::curves] > 0 || !one_region || !(normal.norm() > smooth_sum * count)) return;
  const TangentPlane tangents(sum);
  plane.axes = tangents.axes();
  const Eigen::Matrix2d turned = to_turned_square(sum, tangents);
  if (turned.isZero(0)) return;
  plane.to_square = Eigen::Rotation2Dd(-angle) * turned;
  const Vector3d middle = mean_of(sum);
  plane.position += geometry::tangential(middle, tangents.a3);
  plane.most = sum[Sum::edges] > 0 ? Kind::narrow : Kind::full;
}

Patches::Terms Patches::basis(const Plane& plane, const Vector3d& position) const {
  const Vector3d d = position - plane.position;
  const Eigen::Vector2d s = plane.to_square * Eigen::Vector2d(d.dot(plane.axes.t1), d.dot(plane.axes.t2));
  std::array<std::array<double, most_degree + 1>, 2> chebyshev;
  const auto degree = static_cast<std::size_t>(degree_);
  for (std::size_t a = 0; a < 2; ++a) {
    const double x = s[static_cast<Eigen::Index>(a)];
    chebyshev[a][0] = 1;
    chebyshev[a][1] = x;
    for (std::size_t i = 2; i <= degree; ++i) chebyshev[a][i] = 2 * x * chebyshev[a][i - 1] - chebyshev[a][i - 2];
  }
  Terms row(terms_);
  Eigen::Index term = 0;
  for (std::size_t i = 0; i <= degree; ++i)
    for (std::size_t j = 0; i + j <= degree; ++j) row[term++] = chebyshev[0][i] * chebyshev[1][j];
  return row;
}

bool Patches::reaches(const Plane& plane, const SurfaceAxes& axes) const {
  return axes.a3.dot(plane.axes.a3) >= least_cosine;
}

// Column by column, then the number of points whose normals are too far from the vertex's.
algebra::Vector Patches::normal_matrices(const std::vector<CellResultants>& cells) const {
  algebra::Vector matrices(vertices_.layout(), static_cast<int>(terms_ * terms_ + 1));
  for_points(cells, [&](algebra::LocalIndex vertex, const Plane& plane, const CellResultants& cell, std::size_t p) {
    const auto own = matrices.at(vertex);
    if (!reaches(plane, cell.axes[p])) {
      own.back() += 1;
      return;
    }
    const Terms row = basis(plane, cell.position[p]);
    Eigen::Map<Eigen::MatrixXd>(own.data(), terms_, terms_) += row.transpose() * row;
  });
  matrices.accumulate_ghosts();
  return matrices;
}

std::vector<Eigen::Index> Patches::terms_up_to(int first, int second) const {
  std::vector<Eigen::Index> some;
  Eigen::Index term = 0;
  for (int i = 0; i <= degree_; ++i)
    for (int j = 0; i + j <= degree_; ++j, ++term)
      if (i <= first && j <= second) some.push_back(term);
  return some;
}

std::vector<Patches::Candidate> Patches::candidates() const {
  const int k = space_.degree;
  return {{Kind::full, terms_up_to(degree_, degree_)}, {Kind::lower, terms_up_to(degree_, k)},
          {Kind::lower, terms_up_to(k, degree_)},      {Kind::narrow, terms_up_to(degree_, k - 1)},
          {Kind::narrow, terms_up_to(k - 1, degree_)}, {Kind::narrow, terms_up_to(k, k)},
          {Kind::narrow, terms_up_to(k - 1, k - 1)}};
}

void Patches::decompose(const algebra::Vector& normal_matrices) {
  kinds_ = algebra::Vector(vertices_.layout(), 1);
  solvers_.resize(static_cast<std::size_t>(vertices_.layout()->owned));
  for (algebra::LocalIndex vertex = 0; vertex < vertices_.layout()->owned; ++vertex) {
    const auto own = normal_matrices.at(vertex);
    const Kind most = plane(vertex).most;
    if (most == Kind::none || own.back() > 0) continue;
    const Eigen::Map<const Eigen::MatrixXd> matrix(own.data(), terms_, terms_);
    for (const Candidate& candidate : candidates_) {
      const auto eigen = geometry::symmetric_eigen(Eigen::MatrixXd(matrix(candidate.terms, candidate.terms)));
      if (!(eigen.values[0] > least_eigenvalue * eigen.values.tail<1>()[0])) continue;
      solvers_[static_cast<std::size_t>(vertex)] = {
          .terms = &candidate.terms,
          .inverse = eigen.vectors * eigen.values.cwiseInverse().asDiagonal() * eigen.vectors.transpose()};
      kinds_.at(vertex)[0] = static_cast<double>(std::min(candidate.kind, most));
      break;
    }
  }
  kinds_.update_ghosts();
}

Eigen::MatrixXd Patches::solve(algebra::LocalIndex vertex, const Eigen::MatrixXd& right) const {
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(right.rows(), right.cols());
  const Solver& solver = solvers_[static_cast<std::size_t>(vertex)];
  if (solver.terms) coefficients(*solver.terms, Eigen::all) = solver.inverse * right(*solver.terms, Eigen::all);
  return coefficients;
}

Patches::Kind Patches::kind(algebra::LocalIndex vertex) const {
  return static_cast<Kind>(static_cast<int>(kinds_.at(vertex)[0]));
}

Patches::Kind Patches::best(std::size_t cell) const {
  Kind best = Kind::none;
  for (int k = 0; k < corners_; ++k) best = std::max(best, kind(vertices_.at(space_, cell, k)));
  return best;
}

}  // namespace plastron::recovery
