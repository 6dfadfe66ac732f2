#include <plastron/energy/load_vector.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/energy/distributed_loads.hpp>
#include <plastron/energy/follower_pressure.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/mesh/basis.hpp>

#include <fmt/format.h>

#include <Eigen/SVD>

#include <algorithm>
#include <set>

namespace plastron::energy {

namespace {

/// The place of a load (collective). Its integrals are sums over nodes, so that the sums of force and moment in results are exact.
class LoadedPlace {
 public:
  LoadedPlace(const ShellOperator& shell, const TotalForce& load)
      : shell_(shell), load_(load), areas_(nodal({"1", "", ""})), size_(sum(areas_)[0]) {
    if (size_ > 0 || !load.spot) return;
    throw LoadError(
        fmt::format("a load acts nowhere: no place of the shell is nearer than radius = {:.6g} to its point "
                    "({:.6g}, {:.6g}, {:.6g}); correct the point, or give a larger radius",
                    load.spot->radius, load.spot->point[0], load.spot->point[1], load.spot->point[2]));
  }

  /// Returns forces that have the sum and the moment of the load.
  algebra::Vector forces() const {
    algebra::Vector f(shell_.space().layout, 6);
    for (std::size_t at = 0; at < f.owned().size(); at += 6) set(at, load_.force * (areas_.owned()[at] / size_), f);
    if (!load_.moment.isZero(0)) add_moment(f);
    return f;
  }

 private:
  using Texts = std::array<std::string, 3>;

  static void set(std::size_t at, const Vector3d& force, algebra::Vector& f) {
    for (std::size_t k = 0; k < 3; ++k) f.owned()[at + k] += force[static_cast<Eigen::Index>(k)];
  }

  static Vector3d at_node(const algebra::Vector& f, std::size_t at) {
    return {f.owned()[at], f.owned()[at + 1], f.owned()[at + 2]};
  }

  /// Returns the integrals of three functions times each shape function.
  algebra::Vector nodal(const Texts& texts) const {
    VectorExpression density;
    for (std::size_t k = 0; k < 3; ++k)
      if (!texts[k].empty()) density[k] = geometry::Expression::made(texts[k], {});
    return distributed_forces(shell_, load_.spread(density), load_.spot.has_value());
  }

  Vector3d sum(const algebra::Vector& f) const {
    Vector3d all = Vector3d::Zero();
    for (std::size_t at = 0; at < f.owned().size(); at += 6) all += at_node(f, at);
    for (double& component : all) component = algebra::sum_over_ranks(component, shell_.space().layout->comm);
    return all;
  }

  /// Positions of the owned nodes.
  std::vector<Vector3d> positions() const {
    const fem::Space& space = shell_.space();
    std::vector<Vector3d> all(areas_.owned().size() / 6, Vector3d::Zero());
    const std::vector<Vector2d> xi = mesh::node_points(space.shape(), space.degree);
    for (std::size_t c = 0; c < space.owned_cells; ++c) {
      const auto places = shell_.surface().places(space.cells[c], xi, true);
      const auto nodes = space.nodes(c);
      for (std::size_t k = 0; k < xi.size(); ++k)
        if (const auto node = static_cast<std::size_t>(nodes[k]); node < all.size())
          all[node] = {places[k].X, places[k].Y, places[k].Z};
    }
    return all;
  }

  /// Adds omega x (X - c) per area, with omega such that the moment about c is the given one.
  void add_moment(algebra::Vector& f) const {
    const std::vector<Vector3d> position = positions();
    algebra::Vector weighted(shell_.space().layout, 6);  // by position
    for (std::size_t at = 0; at < f.owned().size(); at += 6) set(at, areas_.owned()[at] * position[at / 6], weighted);
    const Vector3d centre = sum(weighted) / size_;
    const auto from_centre = [&](int k) { return fmt::format("{} - ({:.17g})", "XYZ"[k], centre[k]); };
    algebra::Vector arms = nodal({from_centre(0), from_centre(1), from_centre(2)});
    const Vector3d rest = sum(arms) / size_;
    for (std::size_t at = 0; at < f.owned().size(); at += 6) set(at, -rest * areas_.owned()[at], arms);
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // sum of d x (omega x arm)
    for (std::size_t at = 0; at < f.owned().size(); at += 6) {
      const Vector3d d = position[at / 6] - centre, arm = at_node(arms, at);
      inertia += d.dot(arm) * Eigen::Matrix3d::Identity() - arm * d.transpose();
    }
    for (double& entry : inertia.reshaped()) entry = algebra::sum_over_ranks(entry, shell_.space().layout->comm);
    constexpr double straight = 1e-9;  // relative to the largest inertia
    Eigen::JacobiSVD<Eigen::Matrix3d> solver(inertia, Eigen::ComputeFullU | Eigen::ComputeFullV);
    solver.setThreshold(straight);
    const Vector3d omega = solver.solve(load_.moment);
    if ((inertia * omega - load_.moment).norm() > straight * load_.moment.norm())
      throw LoadError(
          "the moment of a load turns about the straight line of its places, and forces on a line have no moment about "
          "it; give the load a region or a point, or write it as couple");
    for (std::size_t at = 0; at < f.owned().size(); at += 6) set(at, omega.cross(at_node(arms, at)), f);
  }

  const ShellOperator& shell_;
  const TotalForce& load_;
  algebra::Vector areas_;  ///< of the nodes: the place's area, or its length, in the first component
  double size_;            ///< their sum
};

/// Returns the forces of loads, without those of rigid bodies (collective).
algebra::Vector forces_of(const ShellOperator& shell, const Loads& loads) {
  algebra::Vector f = distributed_forces(shell, loads);
  for (const TotalForce& total : loads.totals) algebra::axpy(1, LoadedPlace(shell, total).forces(), f);
  return f;
}

}  // namespace

algebra::Vector load_vector(const ShellOperator& shell, const Loads& loads) {
  algebra::Vector f = forces_of(shell, loads);
  for (const fem::PlacedBody& body : shell.space().bodies) add_body_load(shell.space(), body, f);
  return f;
}

std::vector<LoadPart> load_parts(const ShellOperator& shell, const Loads& loads) {
  std::set<int> factors{-1, loads.gravity_factor};
  for (const AreaLoad& load : loads.on_areas) factors.insert(load.factor);
  for (const EdgeLoad& load : loads.on_edges) factors.insert(load.factor);
  for (const TotalForce& load : loads.totals) factors.insert(load.factor);
  for (const fem::PlacedBody& placed : shell.space().bodies) factors.insert(placed.body.factor);
  std::vector<LoadPart> parts;
  for (const int factor : factors) {
    const Loads own = loads.of(factor);
    LoadPart& part = parts.emplace_back(LoadPart{.factor = factor,
                                                 .forces = forces_of(shell, own),
                                                 .follows = std::ranges::any_of(own.on_areas, &AreaLoad::follows)});
    part.pressure =
        algebra::in_agreement<LoadError>(shell.space().layout->comm, [&] { return follower_pressure(shell, own); });
    for (const fem::PlacedBody& placed : shell.space().bodies)
      if (placed.body.factor == factor) add_body_load(shell.space(), placed, part.forces);
  }
  return parts;
}

algebra::Vector initial_forces(const ShellOperator& shell, const Factors& factors) {
  algebra::Vector f(shell.space().layout, 6);
  if (!shell.sections().have_initial_strains()) return f;
  algebra::in_agreement<LoadError>(shell.space().layout->comm, [&] {
    for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
      const auto initial = shell.weighted_initial_stresses(c, factors);
      if (!initial) continue;
      if (!initial->allFinite()) {
        const auto place = shell.surface().places(shell.space().cells[c], shell.tables().quadrature.xi, false).front();
        throw LoadError(fmt::format(
            "a temperature is infinite or not a number near x = {:.6g}, y = {:.6g}; it must be finite where it acts",
            place.x, place.y));
      }
      shell.scatter(c, shell.forces(c, *initial), f);
    }
  });
  f.accumulate_ghosts();
  return f;
}

}  // namespace plastron::energy
