#include <plastron/assembly/nodal_coordinates.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/assembly/constrained_coordinates.hpp>
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/obstacle/error.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace plastron::assembly {

namespace {

/// Returns the gaps of all local nodes, one list for each obstacle.
std::vector<std::vector<obstacle::Gap>> all_gaps(const std::vector<NodalPoint>& points,
                                                 const std::vector<obstacle::Reach>& reaches,
                                                 const RigidObstacles& obstacles, const State& state) {
  std::vector<std::vector<obstacle::Gap>> gaps(obstacles.all.size());
  const auto point = [&](std::size_t i) {
    return shell_point(points[i].phi, points[i].a3, points[i].thickness, state.at(i));
  };
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    obstacles.prepare_gaps(obstacles.all[k], points.size(), point);
    for (std::size_t i = 0; i < points.size(); ++i)
      gaps[k].push_back(reaches.empty() ? obstacles.gap(k, point(i)) : obstacles.gap(k, point(i), reaches[i]));
  }
  return gaps;
}

/// Returns the gaps of all local nodes in the state, one list for each obstacle.
std::vector<std::vector<double>> gaps_in_state(const std::vector<std::vector<obstacle::Gap>>& gaps,
                                               const std::vector<NodalPoint>& points, const State& state) {
  std::vector<std::vector<double>> values(gaps.size());
  for (std::size_t k = 0; k < gaps.size(); ++k)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector6 y = state.at(i);
      values[k].push_back(gaps[k][i](y.head<3>(), geometry::tangential(y.tail<3>(), points[i].a3)));
    }
  return values;
}

/// The nearest face of all sides of a fold to an obstacle.
struct NearestFace {
  double gap = std::numeric_limits<double>::infinity();  ///< distance of the face in the state [m]
  double z = 0;                                          ///< its height above the mid-surface of its side [m]
};

/// Returns the nearest faces of folds, by obstacle and local node; only those of the nodes that decide the displacement are set
/// (collective).
std::vector<std::map<std::size_t, NearestFace>> faces_at_folds(const fem::Space& space,
                                                               const std::vector<std::vector<obstacle::Gap>>& gaps,
                                                               const std::vector<std::vector<double>>& values) {
  struct Candidate {
    algebra::GlobalIndex decides;
    std::size_t obstacle;
    NearestFace face;
  };
  std::vector<Candidate> mine;
  const auto add = [&](algebra::LocalIndex decides, algebra::LocalIndex side) {
    const auto node = static_cast<std::size_t>(side);
    for (std::size_t k = 0; k < gaps.size(); ++k)
      mine.push_back({space.layout->global(decides), k, {values[k][node], gaps[k][node].z}});
  };
  for (const constraints::Row& row : space.kinks.rows()) {
    if (row.node >= space.layout->owned) continue;
    add(row.terms.front().node, row.node);
    add(row.terms.front().node, row.terms.front().node);
  }
  std::map<algebra::GlobalIndex, std::size_t> local;
  for (algebra::LocalIndex i = 0; i < space.layout->local_size(); ++i)
    local.emplace(space.layout->global(i), static_cast<std::size_t>(i));
  std::vector<std::map<std::size_t, NearestFace>> faces(gaps.size());
  for (const Candidate& candidate : algebra::gathered(mine, space.layout->comm)) {
    const auto node = local.find(candidate.decides);
    if (node == local.end()) continue;
    NearestFace& face = faces[candidate.obstacle][node->second];
    if (candidate.face.gap < face.gap) face = candidate.face;
  }
  return faces;
}

/// Marks the sides of folds that have the nearest face: 1 at their nodes, 0 at the nodes of other sides (collective).
algebra::Vector nearest_faces(const fem::Space& space, const std::vector<std::vector<double>>& own,
                              const std::vector<std::map<std::size_t, NearestFace>>& faces, double size) {
  constexpr double equal = 1e-12;
  const std::size_t obstacles = own.size();
  algebra::Vector nearest(space.layout, static_cast<int>(std::max<std::size_t>(obstacles, 1)));
  std::ranges::fill(nearest.local(), 1.0);
  const auto compare = [&](std::size_t node, std::size_t decides) {
    for (std::size_t k = 0; k < obstacles; ++k)
      if (const auto face = faces[k].find(decides); face != faces[k].end())
        nearest.local()[node * obstacles + k] = own[k][node] <= face->second.gap + equal * size ? 1 : 0;
  };
  for (const constraints::Row& row : space.kinks.rows()) {
    const auto decides = static_cast<std::size_t>(row.terms.front().node);
    compare(static_cast<std::size_t>(row.node), decides);
    compare(decides, decides);
  }
  nearest.update_ghosts();
  return nearest;
}

/// The gap of a fold, whose displacement moves the faces of all sides alike. It has the distance of the nearest face. Its normal is
/// that at the mid-surface: two faces may be equally near, and their normals differ.
obstacle::Gap gap_of_fold(const obstacle::Obstacle& obstacle, const NearestFace& face, const NodalPoint& point,
                          const Vector3d& u) {
  const obstacle::Nearest middle = obstacle.nearest(point.phi + u);
  return {.initial = face.gap - middle.normal.dot(u),
          .normal = middle.normal,
          .z = face.z,
          .contact_point = point.phi - (middle.distance - face.gap) * middle.normal,
          .arm = 0};
}

/// Marks the owned nodes that decide the displacement at a kink (collective).
std::vector<char> deciding_at_kinks(const fem::Space& space) {
  algebra::Vector kinked(space.layout, 1);
  for (const constraints::Row& row : space.kinks.rows())
    if (row.node < space.layout->owned) kinked.local()[static_cast<std::size_t>(row.node)] = 1;
  space.kinks.apply_transposed(kinked);
  std::vector<char> marks;
  for (const double number : kinked.owned()) marks.push_back(number > 0.5 ? 1 : 0);
  return marks;
}

/// Returns the coordinates of one owned node. A constrained node has no bounds: its rows touch no obstacle.
NodeCoordinates owned_coordinates(const NodalCoordinates& all, std::size_t i, const NodalPoint& point,
                                  const NodeSupport& support, const RigidObstacles& obstacles, const State& state,
                                  double size) {
  NodeCoordinates node;
  if (all.space->constraints.constrains(i)) {
    node = constrained_coordinates(*all.space, static_cast<algebra::LocalIndex>(i), point, support, size);
    for (std::size_t k = 0; k < all.gaps.size(); ++k)
      node.rows.push_back({.obstacle = static_cast<int>(k), .bound_gap = NAN});
  } else {
    std::vector<obstacle::Gap> gaps;
    std::vector<double> lifts;
    for (std::size_t k = 0; k < all.gaps.size(); ++k) {
      gaps.push_back(all.gaps[k][i]);
      lifts.push_back(state.lift(i, k));
    }
    node = node_coordinates(point, support, gaps, lifts, state.at(i), size);
  }
  for (ContactRow& row : node.rows) row.node = i;
  if (const std::optional<std::size_t> bed = obstacles.on_bed()) {
    const Vector6 y = state.at(i);
    const double entered =
        state.lift(i, *bed) - all.gaps[*bed][i](y.head<3>(), geometry::tangential(y.tail<3>(), point.a3));
    put_on_bed(all.space->constraints.constrains(i) ? std::nullopt : bed, obstacles.all[*bed].bed.segment(entered),
               point, node);
  }
  return node;
}

}  // namespace

obstacle::ShellPoint shell_point(const Vector3d& phi, const Vector3d& a3, double thickness, const Vector6& moved) {
  return {phi, a3, thickness, moved.head<3>(), geometry::tangential(moved.tail<3>(), a3)};
}

bool NodalCoordinates::is_fixed_inside(const ContactRow& row, const NodalPoint& point) const {
  if (row.is_touchable() || row.is_left_out) return false;
  const double initial = gaps[static_cast<std::size_t>(row.obstacle)][row.node].initial;
  return row.bound_gap < -1e-12 * (point.phi.norm() + std::abs(initial)) - gap_rounding * point.thickness;
}

NodalCoordinates nodal_coordinates(std::shared_ptr<const fem::Space> space_pointer,
                                   const std::vector<NodalPoint>& points, const std::vector<NodeSupport>& supports,
                                   const RigidObstacles& obstacles, element::Formulation formulation,
                                   const State& state) {
  const fem::Space& space = *space_pointer;
  const MPI_Comm comm = space.layout->comm;
  const auto local = static_cast<std::size_t>(space.layout->local_size());
  const int width = element::is_relaxed(formulation) || obstacles.on_bed() ? 6 : 5;
  NodalCoordinates coordinates{.width = width,
                               .basis = std::vector<NodeBasis>(local),
                               .space = std::move(space_pointer),
                               .lower = algebra::Vector(space.layout, width),
                               .upper = algebra::Vector(space.layout, width)};
  const double size = bounding_box(
                          points.size(), [&](std::size_t i) { return points[i].phi; }, comm)
                          .longest_side();
  algebra::Vector bases(space.layout, 36);
  std::vector<std::vector<obstacle::Gap>> gaps;
  const std::vector<obstacle::Reach> reaches = reaches_of(space, points, obstacles.all);
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] { gaps = all_gaps(points, reaches, obstacles, state); });
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(space.kinks.rows().size()), comm) > 0) {
    const auto own = gaps_in_state(gaps, points, state);
    const auto faces = faces_at_folds(space, gaps, own);
    coordinates.nearest_faces = nearest_faces(space, own, faces, size);
    algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
      for (std::size_t k = 0; k < gaps.size(); ++k)
        for (const auto& [node, face] : faces[k])
          gaps[k][node] = gap_of_fold(obstacles.all[k], face, points[node], state.at(node).head<3>());
    });
  }
  coordinates.gaps = std::move(gaps);
  const std::vector<char> decides = deciding_at_kinks(space);
  algebra::in_agreement<SupportError, obstacle::ObstacleError>(comm, [&] {
    for (std::size_t i = 0; i < supports.size(); ++i) {
      NodeCoordinates node = owned_coordinates(coordinates, i, points[i], supports[i], obstacles, state, size);
      // The forms (M13) and (M14) see only gradients of r . a_3: at kinks it vanishes, as on Gamma_0, on all sides.
      if (decides[i] && !obstacles.on_bed())
        node.lower[NodalCoordinates::normal_rotation] = node.upper[NodalCoordinates::normal_rotation] = 0;
      Eigen::Map<NodeBasis>{bases.at(i).data()} = node.basis;
      std::copy_n(node.lower.begin(), width, coordinates.lower.at(i).begin());
      std::copy_n(node.upper.begin(), width, coordinates.upper.at(i).begin());
      coordinates.rows.insert(coordinates.rows.end(), node.rows.begin(), node.rows.end());
    }
  });
  // Ghosts take from their owners: a basis must be equal on all ranks to the last bit.
  for (algebra::Vector* of_owners : {&bases, &coordinates.lower, &coordinates.upper}) of_owners->update_ghosts();
  for (std::size_t i = 0; i < local; ++i) coordinates.basis[i] = Eigen::Map<const NodeBasis>{bases.at(i).data()};
  return coordinates;
}

namespace {

// Works on all nodes. With sizes known at compile time it takes a third of the time.
template <int width>
void times_all_bases(std::span<const NodeBasis> bases, const double* z, double* y) {
  for (std::size_t i = 0; i < bases.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(y + 6 * i).noalias() =
        bases[i].leftCols<width>() * Eigen::Map<const Eigen::Matrix<double, width, 1>>(z + width * i);
}
template <int width>
void add_all_transposed(std::span<const NodeBasis> bases, const double* f, double* z) {
  for (std::size_t i = 0; i < bases.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, width, 1>>(z + width * i).noalias() +=
        bases[i].leftCols<width>().transpose() * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(f + 6 * i);
}

}  // namespace

void NodalCoordinates::add_bed_forces(const algebra::Vector& z, algebra::Vector& forces) const {
  for (const ContactRow& row : rows) {
    if (row.bed == 0) continue;
    const std::size_t surface = at(row.node, row.coordinate), gap = at(row.node, row.gap_coordinate);
    const double force = row.bed * (z.local()[surface] - row.gap_scale * z.local()[gap]);
    forces.local()[surface] += force;
    forces.local()[gap] -= row.gap_scale * force;
  }
}

void NodalCoordinates::add_bed_stiffness(algebra::Matrix& matrix) const {
  for (const ContactRow& row : rows) {
    if (row.bed == 0) continue;
    Eigen::RowVectorXd s = Eigen::RowVectorXd::Zero(width);
    s[row.coordinate] = 1;
    s[row.gap_coordinate] = -row.gap_scale;
    const RowMatrix block = row.bed * s.transpose() * s;
    const auto node = static_cast<algebra::LocalIndex>(row.node);
    matrix.add({&node, 1}, {block.data(), static_cast<std::size_t>(block.size())});
  }
}

std::vector<char> NodalCoordinates::prescribed() const {
  std::vector<char> marks(lower.owned().size());
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = lower.owned()[i] == upper.owned()[i];
  return marks;
}

void NodalCoordinates::to_cartesian(const algebra::Vector& z, algebra::Vector& y) const {
  PLASTRON_ASSERT(z.block() == width && y.block() == 6 && z.local().size() == at(basis.size(), 0) &&
                      y.local().size() == 6 * basis.size(),
                  z.block(), width, y.block(), z.local().size(), y.local().size(), basis.size());
  if (width == 5)
    times_all_bases<5>(basis, z.local().data(), y.local().data());
  else
    times_all_bases<6>(basis, z.local().data(), y.local().data());
  space->constraints.apply(y);
}

Vector6 NodalCoordinates::direction(std::size_t node, int k) const {
  const constraints::Row* row = space->constraints.find(node);
  if (!row) return basis[node].col(k);
  // The displacement of a constrained node is another node's or a body's, also where it stores a motion of the body.
  Vector6 turn = basis[node].col(k);
  turn.head<3>().setZero();
  return row->own() * turn;
}

void NodalCoordinates::add_transposed(algebra::Vector& f, algebra::Vector& z) const {
  PLASTRON_ASSERT(
      z.block() == width && f.block() == 6 && f.owned().size() == 6 * static_cast<std::size_t>(z.layout()->owned),
      z.block(), width, f.block(), f.owned().size(), z.layout()->owned);
  space->constraints.apply_transposed(f);
  const std::span<const NodeBasis> owned(basis.data(), static_cast<std::size_t>(z.layout()->owned));
  if (width == 5)
    add_all_transposed<5>(owned, f.local().data(), z.local().data());
  else
    add_all_transposed<6>(owned, f.local().data(), z.local().data());
}

namespace {

template <int width>
RowMatrix times_bases(const RowMatrix& cartesian, const NodalCoordinates& coordinates,
                      std::span<const algebra::LocalIndex> nodes) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  RowMatrix result(cartesian.rows(), width * n);
  for (Eigen::Index i = 0; i < n; ++i)
    result.middleCols<width>(width * i).noalias() =
        cartesian.middleCols<6>(6 * i) *
        coordinates.basis[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])].leftCols<width>();
  return result;
}

}  // namespace

constraints::NodeColumns in_coordinates(const NodalCoordinates& coordinates, std::span<const algebra::LocalIndex> of,
                                        RowMatrix cartesian) {
  auto [nodes, matrix] = coordinates.space->constraints.on_sources(of, std::move(cartesian));
  if (coordinates.width == 5) return {nodes, times_bases<5>(matrix, coordinates, nodes)};
  return {nodes, times_bases<6>(matrix, coordinates, nodes)};
}

constraints::NodeColumns on_both_sides(const NodalCoordinates& coordinates, std::span<const algebra::LocalIndex> nodes,
                                       RowMatrix matrix) {
  const RowMatrix half = in_coordinates(coordinates, nodes, std::move(matrix)).matrix;
  return in_coordinates(coordinates, nodes, half.transpose());
}

}  // namespace plastron::assembly
