// Rigid bodies that carry edges of the shell.
#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/fem/boundary_nodes.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/fem/kept_angles.hpp>
#include <plastron/geometry/rotation.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace plastron::fem {

namespace {

using algebra::GlobalIndex, algebra::LocalIndex;
using Eigen::Matrix3d, Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The places of a body's nodes by number, known to all ranks.
using Members = std::map<GlobalIndex, BoundaryNode>;

/// Returns the node that each constrained node equals; none for a hanging node with several masters (collective).
std::map<GlobalIndex, std::optional<GlobalIndex>> equal_nodes(const Space& space) {
  const algebra::Layout& layout = *space.layout;
  std::vector<std::pair<GlobalIndex, std::optional<GlobalIndex>>> mine;
  for (const constraints::Row& row : space.continuity.rows()) {
    if (row.node >= layout.owned) continue;
    const bool is_equal = row.terms.size() == 1;
    mine.emplace_back(layout.global(row.node),
                      is_equal ? std::optional(layout.global(row.terms[0].node)) : std::nullopt);
  }
  const auto all = algebra::gathered(mine, layout.comm);
  return {all.begin(), all.end()};
}

Members members_of(const RigidBody& body, const Space& space, const Surface& surface,
                   const std::map<GlobalIndex, std::optional<GlobalIndex>>& equal) {
  Members members;
  const std::string what = fmt::format("an edge of the rigid body \"{}\"", body.name);
  for (const std::string& boundary : body.boundaries)
    for (BoundaryNode node : nodes_on(space, surface, boundary_index(*space.coarse, boundary, what.c_str()))) {
      if (const auto other = equal.find(node.node); other != equal.end()) {
        if (!other->second) continue;
        node.node = *other->second;
      }
      members.emplace(node.node, node);
    }
  return members;
}

/// Motion matrix for (d, length theta), with theta x v = -[v]x theta.
Matrix6 motion_at(const RigidBody& body, const BoundaryNode& node, double length) {
  Matrix6 w = Matrix6::Zero();
  w.topLeftCorner<3, 3>().setIdentity();
  w.topRightCorner<3, 3>() = -geometry::cross_matrix(node.place - body.reference) / length;
  if (body.turns_normals) w.bottomRightCorner<3, 3>() = -geometry::cross_matrix(node.normal) / length;
  return w;
}

/// D W: displacements unchanged, rotations times length^2.
Matrix6 weighted(Matrix6 w, double length) {
  w.bottomRows<3>() *= length * length;
  return w;
}

/// Part of the largest eigenvalue of the Gram matrix; motions below it are undetermined.
constexpr double no_motion = 1e-10;

std::vector<int> free_components(const RigidBody& body) {
  std::vector<int> free;
  for (int k = 0; k < 6; ++k)
    if (!body.fixed[k]) free.push_back(k);
  return free;
}

Vector6 given_load(const PlacedBody& placed) {
  Vector6 load;
  load << placed.body.force, placed.body.moment / placed.length;
  return load;
}

/// The solution of gram x = right in the determined directions.
Vector6 solved(const PlacedBody& placed, const Vector6& right) {
  const auto modes = geometry::symmetric_eigen(Eigen::MatrixXd(placed.gram));
  Vector6 x = Vector6::Zero();
  for (Eigen::Index k = 0; k < 6; ++k)
    if (modes.values[k] > no_motion * modes.values[5])
      x += modes.vectors.col(k).dot(right) / modes.values[k] * modes.vectors.col(k);
  return x;
}

void check_determined(const PlacedBody& placed) {
  const auto free = free_components(placed.body);
  const double scale = placed.gram.diagonal().maxCoeff();
  if (!free.empty() &&
      geometry::symmetric_eigen(Eigen::MatrixXd(placed.gram(free, free))).values[0] < no_motion * scale)
    throw mesh::DomainError(
        fmt::format("the rigid body \"{}\" is free to turn about the line on which its nodes lie: with rotations = "
                    "false they do not hold it; fix a rotation of it about that line, or leave rotations = true",
                    placed.body.name));
  const Vector6 load = given_load(placed);
  if ((placed.gram * solved(placed, load) - load).norm() > 1e-8 * load.norm())
    throw mesh::DomainError(
        fmt::format("the moment on the rigid body \"{}\" has a part about the line on which its nodes lie, and with "
                    "rotations = false they cannot carry it; leave that part out, for what is fixed there takes it all",
                    placed.body.name));
}

PlacedBody placed_body(const RigidBody& body, const Members& members) {
  if (members.size() < 2)
    throw mesh::DomainError(
        fmt::format("the rigid body \"{}\" carries {} nodes; it needs two or more", body.name, members.size()));
  PlacedBody placed{.body = body, .length = 0};
  for (const auto& [number, node] : members)
    placed.length = std::max(placed.length, (node.place - body.reference).norm());
  for (const auto& [number, node] : members) {
    const Matrix6 w = motion_at(body, node, placed.length);
    placed.gram += w.transpose() * weighted(w, placed.length);
  }
  check_determined(placed);
  return placed;
}

void check_disjoint(const std::vector<RigidBody>& bodies, const std::vector<Members>& members) {
  for (std::size_t k = 0; k < bodies.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      for (const auto& [number, node] : members[k])
        if (members[j].contains(number))
          throw mesh::DomainError(
              fmt::format("the rigid bodies \"{}\" and \"{}\" both carry the node at ({:.6g}, {:.6g}, {:.6g}); bodies "
                          "that share nodes are one body: give it all their boundaries",
                          bodies[j].name, bodies[k].name, node.place[0], node.place[1], node.place[2]));
}

/// The first two nodes are the hosts, so that all ranks agree.
std::array<GlobalIndex, 2> hosts_of(const Members& members) {
  return {members.begin()->first, std::next(members.begin())->first};
}

/// Sets the body's local nodes.
void set_members(const Space& space, const Members& members, PlacedBody& placed) {
  const algebra::Layout& layout = *space.layout;
  const auto hosts = hosts_of(members);
  for (LocalIndex i = 0; i < layout.local_size(); ++i) {
    const auto found = members.find(layout.global(i));
    if (found == members.end()) continue;
    for (std::size_t h = 0; h < 2; ++h) placed.hosts[h] = layout.local(hosts[h]);
    placed.members.push_back({i, motion_at(placed.body, found->second, placed.length)});
  }
}

/// Adds the rows of the body's local nodes.
void add_body_rows(const PlacedBody& placed, std::vector<constraints::Row>& rows) {
  for (const auto& [i, w] : placed.members) {
    constraints::Row& row = rows.emplace_back(constraints::Row{.node = i});
    for (int h = 0; h < 2; ++h) {
      Matrix6 block = Matrix6::Zero();
      block.leftCols<3>() = w.middleCols<3>(3 * h);
      row.terms.push_back(constraints::term(placed.hosts[static_cast<std::size_t>(h)], block));
    }
    if (placed.body.turns_normals) continue;
    Matrix6 own = Matrix6::Zero();
    own.bottomRightCorner<3, 3>().setIdentity();
    row.terms.push_back(constraints::term(i, own));
  }
}

/// Returns the rows of the kinks that no body contains. A body must contain all nodes of a kink or none.
std::vector<constraints::Row> kinks_beside(const std::vector<RigidBody>& bodies, const std::vector<Members>& members,
                                           const Space& space) {
  const algebra::Layout& layout = *space.layout;
  std::vector<constraints::Row> rest;
  for (const constraints::Row& kink : space.kinks.rows()) {
    std::vector<GlobalIndex> group;
    for (const constraints::Term& term : space.constraints.find(static_cast<std::size_t>(kink.node))->terms)
      group.push_back(layout.global(term.node));
    bool is_taken = false;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const auto in_body = [&](GlobalIndex number) { return members[k].contains(number); };
      if (std::ranges::none_of(group, in_body)) continue;
      if (!bodies[k].turns_normals || !std::ranges::all_of(group, in_body))
        throw mesh::DomainError(fmt::format(
            "the rigid body \"{}\" carries a node where shells are joined at an angle or by a hinge, but not "
            "all that meet there; give it the edges of all of them, and rotations = true",
            bodies[k].name));
      is_taken = true;
    }
    if (!is_taken) rest.push_back(kink);
  }
  return rest;
}

}  // namespace

std::shared_ptr<const Space> with_rigid_bodies(std::shared_ptr<const Space> space, const Surface& surface,
                                               const std::vector<RigidBody>& bodies) {
  if (bodies.empty()) return space;
  const MPI_Comm comm = space->layout->comm;
  const auto equal = equal_nodes(*space);
  std::vector<Members> members;
  auto result = std::make_shared<Space>(*space);
  for (const RigidBody& body : bodies) {
    members.push_back(members_of(body, *space, surface, equal));
    result->bodies.push_back(placed_body(body, members.back()));
  }
  check_disjoint(bodies, members);
  std::set<GlobalIndex> wanted;
  for (const Members& of_body : members)
    for (LocalIndex i = 0; i < space->layout->local_size(); ++i)
      if (of_body.contains(space->layout->global(i)))
        for (const GlobalIndex host : hosts_of(of_body)) wanted.insert(host);
  result->kinks = constraints::Map(
      algebra::in_agreement<mesh::DomainError>(comm, [&] { return kinks_beside(bodies, members, *space); }), comm);
  widen(*result, wanted);
  std::vector<constraints::Row> rows;
  for (const constraints::Row& kink : result->kinks.rows())
    rows.push_back(*result->constraints.find(static_cast<std::size_t>(kink.node)));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    set_members(*result, members[k], result->bodies[k]);
    add_body_rows(result->bodies[k], rows);
  }
  result->constraints = compose(result->continuity, constraints::Map(std::move(rows), comm), comm);
  return result;
}

namespace {

/// Turns both parts of a matrix on (u, r).
Matrix6 turned_block(const Matrix3d& turn, const Matrix6& block) {
  Matrix6 both = Matrix6::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = turn;
  return both * block * both.transpose();
}

/// Returns the rotation from a body's present one to the prescribed one, where all of it is prescribed; else the difference of
/// the rotation vectors, whose prescribed components vanish in the end.
Vector3d remaining_rotation(const RigidBody& body, const Matrix3d& turn) {
  const Vector3d prescribed = body.prescribed_rotation();
  const bool is_whole = body.fixed[3] && body.fixed[4] && body.fixed[5];
  if (!is_whole) return prescribed - geometry::rotation_vector(turn, prescribed);
  return geometry::rotation_vector(geometry::rotation_of(prescribed) * turn.transpose());
}

/// Returns the rotation nearest to a matrix; about axes that it leaves free, the smallest.
Matrix3d nearest_rotation(const Matrix3d& matrix) {
  constexpr double free = 1e-12;
  const Eigen::JacobiSVD<Matrix3d> svd(matrix + free * matrix.norm() * Matrix3d::Identity(),
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0 ? 1 : -1;
  return svd.matrixU() * Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

/// Returns sum of W' D y over the nodes of a body (collective).
Vector6 moments_of(const Space& space, const PlacedBody& placed, const algebra::Vector& y) {
  Vector6 sum = Vector6::Zero();
  for (const auto& [node, motion] : placed.members)
    if (node < space.layout->owned)
      sum += weighted(motion, placed.length).transpose() *
             Eigen::Map<const Vector6>(y.at(static_cast<std::size_t>(node)).data());
  for (double& component : sum) component = algebra::sum_over_ranks(component, space.layout->comm);
  return sum;
}

}  // namespace

PlacedBody turned_body(PlacedBody placed, const BodyPlace& place) {
  placed.gram = turned_block(place.turn, placed.gram);
  for (BodyNode& member : placed.members) member.motion = turned_block(place.turn, member.motion);
  const Vector3d rotation = remaining_rotation(placed.body, place.turn);
  for (std::size_t k = 0; k < 3; ++k) {
    if (auto& way = placed.body.fixed[k]) *way -= place.displacement[static_cast<Eigen::Index>(k)];
    if (auto& angle = placed.body.fixed[k + 3]) *angle = rotation[static_cast<Eigen::Index>(k)];
  }
  return placed;
}

BodyPlace place_of(const Space& space, const PlacedBody& placed, const algebra::Vector& y) {
  struct {
    double count = 0;
    Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
    Matrix3d products = Matrix3d::Zero();
  } sums;
  for (const auto& [node, motion] : placed.members) {
    if (node >= space.layout->owned) continue;
    const Eigen::Map<const Vector6> moved(y.at(static_cast<std::size_t>(node)).data());
    const Vector3d p = placed.length * turned_vector(motion.topRightCorner<3, 3>()), q = p + moved.head<3>();
    sums.count += 1;
    sums.from += p;
    sums.to += q;
    sums.products += q * p.transpose();
    if (!placed.body.turns_normals) continue;
    const Vector3d a3 = placed.length * turned_vector(motion.bottomRightCorner<3, 3>());
    sums.products += placed.length * placed.length * (a3 + moved.tail<3>()) * a3.transpose();
  }
  const MPI_Comm comm = space.layout->comm;
  sums.count = algebra::sum_over_ranks(sums.count, comm);
  for (double& entry : sums.from) entry = algebra::sum_over_ranks(entry, comm);
  for (double& entry : sums.to) entry = algebra::sum_over_ranks(entry, comm);
  for (double& entry : sums.products.reshaped()) entry = algebra::sum_over_ranks(entry, comm);
  const Matrix3d turn = nearest_rotation(sums.products - sums.to * sums.from.transpose() / sums.count);
  return {.displacement = (sums.to - turn * sums.from) / sums.count, .turn = turn};
}

BodyMotion fitted_motion(const Space& space, const PlacedBody& placed, const algebra::Vector& y) {
  const Vector6 motion = solved(placed, moments_of(space, placed, y));
  return {motion.head<3>(), motion.tail<3>() / placed.length};
}

std::shared_ptr<const Space> with_part_of_motions(std::shared_ptr<const Space> space,
                                                  const std::function<double(const RigidBody&)>& part) {
  if (std::ranges::all_of(space->bodies, [&](const PlacedBody& placed) { return part(placed.body) == 1; }))
    return space;
  auto result = std::make_shared<Space>(*space);
  for (PlacedBody& placed : result->bodies)
    for (auto& value : placed.body.fixed)
      if (value) *value *= part(placed.body);
  return result;
}

std::shared_ptr<const Space> turned(const std::shared_ptr<const Space>& space, std::span<const Vector3d> normals,
                                    std::span<const Vector3d> directors, std::span<const BodyPlace> places) {
  if (space->bodies.empty() && space->kinks.is_identity()) return space;
  const MPI_Comm comm = space->layout->comm;
  auto result = std::make_shared<Space>(*space);
  std::vector<constraints::Row> rows = turned_kinks(*space, normals, directors);
  for (std::size_t k = 0; k < result->bodies.size(); ++k) {
    result->bodies[k] = turned_body(result->bodies[k], places[k]);
    add_body_rows(result->bodies[k], rows);
  }
  result->constraints = compose(space->continuity, constraints::Map(std::move(rows), comm), comm);
  return result;
}

BodyMotion motion_of(const Space& space, const PlacedBody& placed, const algebra::Vector& y) {
  Vector6 sum = moments_of(space, placed, y), motion = Vector6::Zero();
  for (int k = 0; k < 6; ++k)
    if (const auto& value = placed.body.fixed[k]) motion[k] = k < 3 ? *value : placed.length * *value;
  sum -= placed.gram * motion;
  const auto free = free_components(placed.body);
  const Eigen::MatrixXd of_free = placed.gram(free, free);
  const Eigen::VectorXd solution = of_free.ldlt().solve(Eigen::VectorXd(sum(free)));
  for (std::size_t k = 0; k < free.size(); ++k) motion[free[k]] = solution[static_cast<Eigen::Index>(k)];
  return {motion.head<3>(), motion.tail<3>() / placed.length};
}

void add_body_load(const Space& space, const PlacedBody& placed, algebra::Vector& f) {
  const Vector6 x = solved(placed, given_load(placed));
  for (const auto& [node, motion] : placed.members) {
    if (node >= space.layout->owned) continue;
    Eigen::Map<Vector6>(f.local().data() + 6 * static_cast<std::size_t>(node)) += weighted(motion, placed.length) * x;
  }
}

}  // namespace plastron::fem
