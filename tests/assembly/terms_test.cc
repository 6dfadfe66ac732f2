// The terms of the potential (M31): forces are the derivative of the energy, stiffness is the derivative of the forces, and rigid motions
// cost what they should.
#include "assembly/sample_shells.hpp"

#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/energy/foundation.hpp>
#include <plastron/energy/hinge.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/rotation.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace plastron::assembly {
namespace {

using energy::Foundation;
using geometry::Expression;

algebra::Vector random_motion(const fem::Space& space, int seed, double size = 1) {
  algebra::Vector y(space.layout, 6);
  std::mt19937 generator(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> uniform(-size, size);
  for (double& v : y.owned()) v = uniform(generator);
  y.update_ghosts();
  space.continuity.apply(y);
  return y;
}

algebra::Vector moved(const algebra::Vector& y, double factor, const algebra::Vector& z) {
  algebra::Vector result = y;
  algebra::axpy(factor, z, result);
  result.update_ghosts();
  return result;
}

struct Carrier {
  const char* name;
  Foundation foundation;
};

std::vector<Carrier> carriers() {
  Eigen::Matrix3d axes;
  axes << 0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1;
  const Expression field("2 + x*y", {});
  return {{"normal", {.normal = field}},
          {"tangential below", {.tangential = field, .height = -0.5}},
          {"axes above", {.stiffness = {Expression(1.0), field, Expression(0.0)}, .axes = axes, .height = 0.5}},
          {"shear layer", {.normal = Expression(1.0), .shear = field}},
          {"edge", {.boundaries = {"edge2", "edge3"}, .normal = field, .tangential = Expression(3.0)}},
          {"spring",
           {.point = Eigen::Vector2d(0.4, 0.3), .stiffness = {Expression(1.0), Expression(2.0), Expression(3.0)}}}};
}

energy::ShellOperator operator_on(const test::MeshedSurface& m, bool is_covariant = false) {
  return {m.space, m.surface, test::steel_of(Expression("0.1 + 0.02*x", {})), m.space->shape() == test::quadrilateral,
          is_covariant};
}

/// Returns z . K y of the matrices of a term.
double product_by_matrices(const energy::Term& term, const energy::ShellOperator& shell, const algebra::Vector& state,
                           const algebra::Vector& y, const algebra::Vector& z, const std::string& what) {
  double sum = 0;
  const auto add = [&](const auto& k, const auto& of_y, const auto& of_z) {
    EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-13 * k.cwiseAbs().maxCoeff()) << what;
    sum += Eigen::Map<const Eigen::VectorXd>(of_z.data(), of_z.size())
               .dot(k * Eigen::Map<const Eigen::VectorXd>(of_y.data(), of_y.size()));
  };
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c)
    if (const auto k = term.stiffness(shell, c)) add(*k, shell.gather(c, y), shell.gather(c, z));
  for (const constraints::NodeColumns& k : term.stiffness_between_cells(shell, state)) {
    const auto values = [&](const algebra::Vector& v) {
      element::CellField field(static_cast<Eigen::Index>(k.nodes.size()), 6);
      for (std::size_t i = 0; i < k.nodes.size(); ++i)
        field.row(static_cast<Eigen::Index>(i)) = node_values(v, static_cast<std::size_t>(k.nodes[i])).transpose();
      return field;
    };
    add(k.matrix, values(y), values(z));
  }
  return algebra::sum_over_ranks(sum, shell.space().layout->comm);
}

void expect_consistent(const energy::Term& term, const energy::ShellOperator& shell, const std::string& what) {
  const algebra::Vector y = random_motion(shell.space(), 1), z = random_motion(shell.space(), 2);
  algebra::Vector f(y.layout(), 6);
  term.add_forces(shell, y, f);
  f.accumulate_ghosts();
  const double energy = term.energy(shell, y), work = algebra::dot(f, z),
               scale = std::sqrt(energy * term.energy(shell, z));
  ASSERT_GT(scale, 0) << what;
  EXPECT_NEAR(algebra::dot(f, y) / 2, energy, 1e-12 * energy) << what;
  // The energy is quadratic: central differences of any length are exact.
  EXPECT_NEAR((term.energy(shell, moved(y, 0.5, z)) - term.energy(shell, moved(y, -0.5, z))), work, 1e-11 * scale)
      << what;
  EXPECT_NEAR(product_by_matrices(term, shell, {}, y, z, what), work, 1e-11 * scale) << what;
}

TEST(Terms, HaveForcesAndStiffnessThatAreDerivativesOfTheirEnergy) {
  for (const auto& [shape, degree] :
       {std::pair(test::quadrilateral, 1), std::pair(test::quadrilateral, 3), std::pair(test::triangle, 2)}) {
    const auto m = test::meshed(test::skew(), test::saddle, degree, 1, shape);
    const energy::ShellOperator shell = operator_on(m);
    expect_consistent(*energy::normal_rotation_term(3), shell, "normal rotation");
    for (const auto& [name, foundation] : carriers())
      expect_consistent(*foundation_term(shell, foundation), shell, name);
  }
}

TEST(Terms, AreThoseOfCovariantInterpolationToo) {
  const energy::ShellOperator shell = operator_on(test::meshed(test::skew(), test::saddle, 2, 1), true);
  for (const auto& [name, foundation] : carriers()) {
    const auto term = foundation_term(shell, foundation);
    algebra::Vector y = random_motion(shell.space(), 1), z = random_motion(shell.space(), 2), f(y.layout(), 6);
    term->add_forces(shell, y, f);
    f.accumulate_ghosts();
    EXPECT_NEAR(term->energy(shell, moved(y, 0.5, z)) - term->energy(shell, moved(y, -0.5, z)), algebra::dot(f, z),
                1e-11 * std::sqrt(term->energy(shell, y) * term->energy(shell, z)))
        << name;
  }
}

/// The energy of a motion of a flat plate of 2 x 1.
double energy_of(const Foundation& foundation, const Eigen::Vector3d& c, const Eigen::Vector3d& w) {
  const auto m = test::meshed(domain::Rectangle{.from = {0, 0}, .to = {2, 1}}, test::flat, 2, 1);
  const energy::ShellOperator shell(m.space, m.surface, test::steel_of(Expression(0.1)), true, false);
  const auto points = nodal_geometry(*m.space, *m.surface, shell.tables(), shell.sections());
  auto term = foundation_term(shell, foundation);
  if (!term) return 0;
  Eigen::Vector3d shift = c - w.cross(Eigen::Vector3d(0, 0, 0.3));  // turns about the origin of the plate
  return term->energy(shell, test::rigid_motion(*m.space, points, shift, w));
}

TEST(Foundation, HasTheEnergyOfRigidMotions) {
  const Eigen::Vector3d none(0, 0, 0), up(0, 0, 1), along(1, 0, 0);
  const Expression k(5.0);
  EXPECT_NEAR(energy_of({.normal = k}, up, none), 5, 1e-12);
  EXPECT_NEAR(energy_of({.normal = k}, along, none), 0, 1e-12);
  EXPECT_NEAR(energy_of({.tangential = k}, along, none), 5, 1e-12);
  EXPECT_NEAR(energy_of({.boundaries = {"right"}, .normal = k}, up, none), 2.5, 1e-12);
  EXPECT_NEAR(energy_of({.point = Eigen::Vector2d(0.7, 0.2), .stiffness = {k, k, k}}, up, none), 2.5, 1e-12);
  // w = -y_axis x: u_z = x for the turn -e_y
  EXPECT_NEAR(energy_of({.normal = k}, none, {0, -1, 0}), 2.5 * 8 / 3, 1e-12);
  EXPECT_NEAR(energy_of({.shear = k}, none, {0, -1, 0}), 5, 1e-12);
  // The lower face moves along -z r = e/2.
  EXPECT_NEAR(energy_of({.tangential = k, .height = -0.5}, none, {0, -1, 0}), 5 * 0.05 * 0.05, 1e-13);
}

TEST(Foundation, WithoutStiffnessIsNoTerm) {
  const energy::ShellOperator shell = operator_on(test::meshed(test::skew(), test::saddle, 2, 1));
  EXPECT_EQ(foundation_term(shell, {.normal = Expression(0.0)}), nullptr);
  EXPECT_THROW(foundation_term(shell, {.name = "soil", .normal = Expression("x - 0.5", {})}), energy::LoadError);
  EXPECT_THROW(foundation_term(shell, {.normal = Expression("1/(x-x)", {})}), energy::LoadError);
  EXPECT_THROW(foundation_term(shell, {.boundaries = {"no such"}, .normal = Expression(1.0)}), energy::LoadError);
}

/// (u, r) of a rigid body's nodes after the displacement d and the rotation R about the reference point.
algebra::Vector placed_motion(const fem::Space& space, const Eigen::Vector3d& d, const Eigen::Matrix3d& R) {
  algebra::Vector y(space.layout, 6);
  const fem::PlacedBody& body = space.bodies[0];
  for (const fem::BodyNode& member : body.members) {
    double* values = y.at(static_cast<std::size_t>(member.node)).data();
    const auto arm = [&](int part) -> Eigen::Vector3d {
      return fem::turned_vector(member.motion.block<3, 3>(part, 3)) * body.length;
    };
    Eigen::Map<Eigen::Vector3d>{values} = d + R * arm(0) - arm(0);
    Eigen::Map<Eigen::Vector3d>{values + 3} = R * arm(3) - arm(3);
  }
  return y;
}

// The rotations are up to 2.5, about drawn axes.
TEST(BodySpring, HasForcesAndStiffnessThatAreDerivativesOfItsEnergy) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 1);
  const auto space = fem::with_rigid_bodies(
      m.space, *m.surface, {{.name = "frame", .boundaries = {"edge2"}, .reference = {0.3, -0.2, 0.4}}});
  const energy::ShellOperator shell(space, m.surface, test::steel_of(Expression(0.1)), true, false);
  Eigen::Matrix3d axes;
  axes << 0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1;
  const Foundation spring{.body = "frame",
                          .stiffness = {Expression(1.0), Expression(2.0), Expression(3.0)},
                          .rotation = {Expression(4.0), Expression(0.5), Expression(1.0)},
                          .axes = axes};
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto drawn = [&] { return Eigen::Vector3d(uniform(generator), uniform(generator), uniform(generator)); };
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite})
    for (const double angle : {1e-5, 0.3, 1.4, 2.5}) {
      const auto term = foundation_term(shell, spring, rotations);
      const bool is_finite = rotations == element::Rotations::finite;
      const Eigen::Vector3d d = drawn(), v = drawn(), w = drawn(), theta = angle * drawn().normalized();
      const auto turned = [&](const Eigen::Vector3d& by) -> Eigen::Matrix3d {
        if (is_finite) return geometry::rotation_of(by) * geometry::rotation_of(theta);
        return Eigen::Matrix3d::Identity() + geometry::cross_matrix(theta + by);
      };
      const auto at = [&](double t) { return placed_motion(*space, d + t * v, turned(t * w)); };
      const auto forces = [&](double t) {
        algebra::Vector f(space->layout, 6);
        term->add_forces(shell, at(t), f);
        return f;
      };
      const double t = 1e-5;
      algebra::Vector motion = at(t);
      algebra::axpy(-1, at(-t), motion);
      for (double& value : motion.local()) value /= 2 * t;
      const double slope = (term->energy(shell, at(t)) - term->energy(shell, at(-t))) / (2 * t);
      EXPECT_NEAR(algebra::dot(forces(0), motion), slope, 1e-8) << angle;
      algebra::Vector product(space->layout, 6);
      term->add_product(shell, at(0), motion, product);
      // The second derivative along the motion, in which nodes of a body move on circles with finite rotations.
      const double second =
          (term->energy(shell, at(100 * t)) - 2 * term->energy(shell, at(0)) + term->energy(shell, at(-100 * t))) /
          (1e4 * t * t);
      EXPECT_NEAR(algebra::dot(product, motion), second, 1e-5 * (1 + second)) << angle;
      const auto stiffness = term->stiffness_of_body(shell, 0, at(0));
      ASSERT_TRUE(stiffness);
      Eigen::Matrix<double, 6, 1> q;
      q << v, space->bodies[0].length * w;
      EXPECT_NEAR(q.dot(*stiffness * q), second, 1e-5 * (1 + second)) << angle;
    }
}

/// A loop whose ends meet at a right angle along a curved edge, joined by a hinge; or a tube that a hinge closes.
test::MeshedSurface with_hinge(int degree, mesh::Shape shape, bool is_tube) {
  auto m = is_tube ? test::meshed(domain::Rectangle{.to = {2 * M_PI, 1}, .cells = {6, 1}}, {"cos(x)", "sin(x)", "y"},
                                  degree, 0, shape)
                   : test::meshed(domain::Rectangle{.to = {M_PI, 1}, .cells = {6, 1}},
                                  {"sin(2*x)/2 + 0.1*y^2", "sin(x)", "y"}, degree, 0, shape);
  m.space = fem::joined(m.space, *m.surface, {{.boundaries = {"left", "right"}, .is_hinge = true, .stiffness = 3}});
  return m;
}

struct Hinged {
  test::MeshedSurface m;
  energy::ShellOperator shell = operator_on(m);
  std::vector<NodalPoint> points = nodal_geometry(*m.space, *m.surface, shell.tables(), shell.sections());

  std::shared_ptr<const energy::Term> term(element::Rotations rotations) const {
    return energy::hinge_term(*m.space, places_and_directors(*m.space, points), rotations);
  }
};

/// Degree, shape and whether it is the tube.
std::vector<std::tuple<int, mesh::Shape, bool>> hinged_shells() {
  return {{1, test::quadrilateral, false}, {3, test::quadrilateral, false}, {2, test::triangle, false},
          {1, test::quadrilateral, true},  {3, test::quadrilateral, true},  {2, test::triangle, true}};
}

TEST(Hinge, OfSmallRotationsIsConsistent) {
  for (const auto& [degree, shape, is_tube] : hinged_shells()) {
    const Hinged hinged{with_hinge(degree, shape, is_tube)};
    expect_consistent(*hinged.term(element::Rotations::small), hinged.shell, "hinge");
  }
}

/// The derivative at 0 of a smooth function, of fourth order.
template <class Function>
double slope(const Function& at) {
  const double step = 2e-3;
  return (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
}

TEST(Hinge, OfFiniteRotationsHasForcesAndStiffnessThatAreDerivatives) {
  for (const auto& [degree, shape, is_tube] : hinged_shells()) {
    const Hinged hinged{with_hinge(degree, shape, is_tube)};
    const energy::ShellOperator& shell = hinged.shell;
    const auto term = hinged.term(element::Rotations::finite);
    const algebra::Vector y = random_motion(shell.space(), 1, 0.1), z = random_motion(shell.space(), 2, 0.1),
                          w = random_motion(shell.space(), 3, 0.1);
    const auto work = [&](const algebra::Vector& state, const algebra::Vector& motion) {
      algebra::Vector f(y.layout(), 6);
      term->add_forces(shell, state, f);
      f.accumulate_ghosts();
      return algebra::dot(f, motion);
    };
    const auto product = [&](const algebra::Vector& one, const algebra::Vector& other) {
      algebra::Vector f(y.layout(), 6);
      term->add_product(shell, y, one, f);
      f.accumulate_ghosts();
      return algebra::dot(f, other);
    };
    const double scale = term->energy(shell, y);
    ASSERT_GT(scale, 0);
    EXPECT_NEAR(slope([&](double t) { return term->energy(shell, moved(y, t, z)); }), work(y, z), 1e-6 * scale);
    EXPECT_NEAR(slope([&](double t) { return work(moved(y, t, z), w); }), product(z, w), 1e-6 * scale);
    EXPECT_NEAR(product(w, z), product(z, w), 1e-11 * scale);
    EXPECT_NEAR(product_by_matrices(*term, shell, y, z, w, "hinge"), product(z, w), 1e-11 * scale);
  }
}

TEST(Hinge, CostsNothingInRigidMotions) {
  for (const auto& [degree, shape, is_tube] : hinged_shells()) {
    const Hinged hinged{with_hinge(degree, shape, is_tube)};
    const auto small = hinged.term(element::Rotations::small), finite = hinged.term(element::Rotations::finite);
    const Eigen::Vector3d c(1, 2, 3), axis = Eigen::Vector3d(1, 2, 2) / 3;
    EXPECT_LT(small->energy(hinged.shell, test::rigid_motion(*hinged.m.space, hinged.points, c, axis)), 1e-26);
    const Eigen::Matrix3d change = Eigen::AngleAxisd(2.5, axis).toRotationMatrix() - Eigen::Matrix3d::Identity();
    algebra::Vector y(hinged.m.space->layout, 6);
    for (std::size_t i = 0; i < hinged.points.size(); ++i) {
      Eigen::Map<Eigen::Vector3d>{y.at(i).data()} = c + change * hinged.points[i].phi;
      Eigen::Map<Eigen::Vector3d>{y.at(i).data() + 3} = change * hinged.points[i].a3;
    }
    EXPECT_LT(finite->energy(hinged.shell, y), 1e-26);
    EXPECT_GT(finite->energy(hinged.shell, random_motion(*hinged.m.space, 1, 0.1)), 1e-6);
  }
}

/// A shell with all kinds of terms, heated.
std::unique_ptr<DiscreteShell> shell_with_terms(element::Rotations rotations) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 1);
  ShellDescription description{.sections = test::steel_of(Expression("0.1 + 0.02*x", {})), .rotations = rotations};
  std::get<shell::Isotropic>(description.sections.common.material.law).expansion = 1e-2;
  description.sections.common.temperatures = {{.mean = Expression("1 + x", {}), .difference = Expression(2.0)}};
  for (const auto& [name, foundation] : carriers()) description.foundations.push_back(foundation);
  return discretise(m.space, m.surface, description);
}

TEST(Potential, HasForcesThatAreTheDerivativeOfItsEnergyInBothModels) {
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite}) {
    const auto discrete = shell_with_terms(rotations);
    const algebra::Vector y = random_motion(discrete->space(), 1, 0.05), z = random_motion(discrete->space(), 2, 0.05);
    const auto at = [&](double t) { return discrete->energies(moved(y, t, z)).total(); };
    const double step = 0.1;  // fourth order: exact for a polynomial of fourth degree
    const double slope = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    EXPECT_NEAR(slope, algebra::dot(forces_of_energy(*discrete, y), z), 1e-10 * at(0));
  }
}

// A rigid motion of a free heated shell that has expanded costs nothing; held, it stores 1/2 eps_0 C eps_0.
TEST(Temperature, StoresNoEnergyInAFreePlate) {
  const double alpha = 1e-2, T = 3, e = 0.1;
  const auto m = test::meshed(test::skew(), test::flat, 2, 1);
  ShellDescription description{.sections = test::steel_of(Expression(e))};
  std::get<shell::Isotropic>(description.sections.common.material.law).expansion = alpha;
  description.sections.common.temperatures = {{.mean = Expression(T)}};
  const auto discrete = discretise(m.space, m.surface, description);
  algebra::Vector y(m.space->layout, 6);
  const double held = discrete->energies(y).total();
  double area = 0;
  for (std::size_t c = 0; c < m.space->owned_cells; ++c) area += discrete->shell.area(c);
  EXPECT_NEAR(held, e * alpha * alpha * T * T / 0.7 * area, 1e-12);
  for (std::size_t i = 0; i < discrete->points.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) y.at(i)[k] = alpha * T * discrete->points[i].phi[static_cast<int>(k)];
  EXPECT_LT(discrete->energies(y).total(), 1e-25 * held + 1e-28);
  EXPECT_LT(algebra::max_abs(forces_of_energy(*discrete, y)), 1e-15);
}

// A curved shell that grows evenly has neither stress nor energy, of one material or of layers of one expansion.
TEST(Temperature, StoresNoEnergyInAFreeCurvedShell) {
  const double alpha = 1e-3, T = 3;
  const auto m = test::meshed(test::skew(), test::saddle, 6, 1);
  const auto layer = shell::Orthotropic{
      .E1 = 3, .E2 = 1, .nu12 = 0.2, .G12 = 0.5, .G13 = 0.5, .G23 = 0.4, .expansion1 = alpha, .expansion2 = alpha};
  shell::Material layered{.law = std::make_shared<const shell::Laminate>(
                              std::vector<shell::Layer>{{.material = layer, .angle = 0.3},
                                                        {.material = shell::Orthotropic::isotropic(2, 0.3, alpha)}},
                              Eigen::Vector3d(1, 0, 0))};
  shell::Material one = test::steel_like();
  std::get<shell::Isotropic>(one.law).expansion = alpha;
  for (const shell::Material& material : {one, layered}) {
    ShellDescription description{.sections = {.common = {.thickness = Expression(0.1), .material = material}}};
    description.sections.common.temperatures = {{.mean = Expression(T)}};
    const auto discrete = discretise(m.space, m.surface, description);
    algebra::Vector y(m.space->layout, 6);
    const double held = discrete->energies(y).total();
    for (std::size_t i = 0; i < discrete->points.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) y.at(i)[k] = alpha * T * discrete->points[i].phi[static_cast<int>(k)];
    EXPECT_LT(discrete->energies(y).total(), 1e-12 * held);
  }
}

}  // namespace
}  // namespace plastron::assembly
