// Estimates of errors: identities that hold on any mesh (M8, M16, M22), and a comparison with a finer mesh.
#include "assembly/sample_shells.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/estimation/estimate.hpp>
#include <plastron/estimation/functionals.hpp>
#include <plastron/estimation/kept_factorisation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plastron::estimation {
namespace {

struct Choice {
  int degree = 2, refinements = 2;
  mesh::Shape shape = mesh::Shape::quadrilateral;
  bool tying = true, has_obstacle = false;
  MPI_Comm comm = MPI_COMM_WORLD;
};

/// A saddle on the unit square, clamped at two opposite edges, under its weight; optionally over a plane.
class SolvedSaddle {
 public:
  explicit SolvedSaddle(const Choice& choice) {
    const domain::Rectangle square{.cells = {2, 2}};
    fem::MeshSequence meshes(domain::coarse_mesh(square, choice.shape), choice.degree, choice.comm);
    for (int i = 0; i < choice.refinements; ++i) meshes.refine({});
    std::map<std::string, geometry::Chart> charts;
    charts.emplace("", geometry::Chart(test::saddle, {}));
    energy::AreaLoad load{};
    load.force = {geometry::Expression(0.0), geometry::Expression(0.0), geometry::Expression(-0.02)};
    assembly::ShellDescription shell{.sections = test::steel_of(geometry::Expression(0.1)),
                                     .tying = choice.tying,
                                     .supports = {test::clamp("left"), test::clamp("right")},
                                     .loads = {.on_areas = {load}}};
    if (choice.has_obstacle) {
      obstacle::Obstacle table{};
      table.placement.translation = {0, 0, 0.3};
      shell.obstacles.all = {table};
    }
    const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, charts);
    discrete_ = assembly::discretise(meshes.space(), surface, shell);
    matrix_.emplace(assembly::stiffness_matrix(*discrete_));
    factor_.emplace(*matrix_);
    kept_.emplace(*factor_, choice.comm);
    box_.emplace(assembly::box_problem(*discrete_, *matrix_));
    z_ = contact::solve(*box_, {}, *kept_);
    EXPECT_EQ(z_.status, contact::Status::solved);
    nodal_ = solution::nodal_solution(*discrete_, z_);
    kept_->keep();
  }
  GoalEstimate estimate(const Functional& functional) { return all({{"goal", functional}}).goals.front(); }
  Estimates all(const std::vector<Goal>& goals) {
    return estimation::estimate({.discrete = *discrete_, .nodal = nodal_, .box = *box_, .z = z_}, *kept_, goals);
  }
  Derivative derivative_of(const Functional& functional) {
    return derivative(functional, {.discrete = *discrete_, .nodal = nodal_, .box = *box_, .z = z_});
  }
  const algebra::Vector& coordinates() const { return z_.z; }
  std::optional<double> buckling() {
    return estimation::buckling({.discrete = *discrete_, .nodal = nodal_, .box = *box_, .z = z_}, *kept_);
  }
  std::int64_t touching() const { return static_cast<std::int64_t>(std::ranges::count(nodal_.touching.owned(), 1.0)); }
  MPI_Comm comm() const { return discrete_->space().layout->comm; }
  int factorisations() const { return factor_->factorisations(); }

 private:
  std::unique_ptr<assembly::DiscreteShell> discrete_;
  std::optional<algebra::Matrix> matrix_;
  std::optional<algebra::Factorisation> factor_;
  std::optional<KeptFactorisation> kept_;
  std::optional<contact::BoxProblem> box_;
  contact::BoxSolution z_;
  solution::NodalSolution nodal_;
};

const std::vector<Choice> elements{{.degree = 2},
                                   {.degree = 3, .refinements = 1},
                                   {.degree = 2, .tying = false},
                                   {.degree = 1, .refinements = 3, .shape = mesh::Shape::triangle},
                                   {.degree = 2, .shape = mesh::Shape::triangle}};

TEST(Estimates, SeeTwiceTheErrorOfTheEnergyInTheWorkOfTheLoads) {
  for (const Choice& choice : elements) {
    SolvedSaddle solved(choice);
    const GoalEstimate energy = solved.estimate(Energy{}), work = solved.estimate(LoadWork{});
    EXPECT_NEAR(work.value, 2 * energy.value, 1e-9 * work.value);
    EXPECT_NEAR(work.estimate, 2 * energy.estimate, 1e-5 * std::abs(work.estimate));
    EXPECT_GT(std::abs(work.estimate), 1e-9 * work.value);
  }
}

TEST(Estimates, FindNoErrorInWhatBalanceAloneDecides) {
  for (const Choice& choice : elements) {
    SolvedSaddle solved(choice);
    const GoalEstimate all = solved.estimate(SupportForce{.component = 2});
    EXPECT_GT(all.value, 0.01);
    EXPECT_LT(all.error(), 1e-8 * all.value);
    const GoalEstimate left = solved.estimate(SupportForce{.boundary = "left", .component = 2});
    EXPECT_GT(left.error(), 1e-8 * left.value);
  }
}

TEST(Estimates, OfObstaclesAndSupportsAreOpposite) {
  SolvedSaddle solved({.degree = 3, .refinements = 2, .has_obstacle = true});
  ASSERT_GT(algebra::sum_over_ranks(solved.touching(), solved.comm()), 0);
  const GoalEstimate table = solved.estimate(ObstacleForce{.component = 2});
  const GoalEstimate supports = solved.estimate(SupportForce{.component = 2});
  EXPECT_GT(table.value, 0);
  EXPECT_NEAR(table.estimate, -supports.estimate, 1e-6 * table.error());
  EXPECT_NEAR(table.contact_edge, supports.contact_edge, 1e-6 * table.error());
  EXPECT_GT(table.contact_edge, 0);
  const GoalEstimate norm = solved.estimate(ObstacleForce{.obstacle = 0});
  EXPECT_NEAR(norm.value, table.value, 1e-9 * table.value);  // the table's normal is vertical
  EXPECT_NEAR(norm.error(), table.error(), 1e-6 * table.error());
}

TEST(Estimates, NeedNoFactorisationOfTheirOwnWithoutObstacles) {
  SolvedSaddle solved({.degree = 2});
  const int before = solved.factorisations();
  solved.estimate(LoadWork{});
  EXPECT_EQ(solved.factorisations(), before);
}

TEST(Estimates, BringTheEnergyNearerToThatOfAFinerMesh) {
  for (const Choice& choice : elements) {
    Choice finer = choice;
    finer.refinements += 2;
    const GoalEstimate goal = SolvedSaddle(choice).estimate(Energy{});
    const double exact = SolvedSaddle(finer).estimate(Energy{}).value;
    EXPECT_LT(std::abs(goal.value + goal.estimate - exact), 0.75 * std::abs(goal.value - exact)) << choice.degree;
  }
}

// The duals are singular at the point and in the corners. Coarse meshes know the size of the error, but not its sign.
TEST(Estimates, HaveTheSizeOfTheErrorOfDisplacementsAndReactions) {
  for (const Choice& choice : elements) {
    Choice finer = choice;
    finer.refinements += 1;
    SolvedSaddle solved(choice), fine(finer);
    for (const Functional& f : {Functional(PointDisplacement{{0.52, 0.37}, 2}),
                                Functional(SupportForce{.boundary = "left", .component = 0})}) {
      const GoalEstimate goal = solved.estimate(f);
      const double error = std::abs(goal.value - fine.estimate(f).value);
      EXPECT_GT(goal.error(), 0.2 * error) << fmt::format("goal {}, degree {}", f.index(), choice.degree);
      EXPECT_LT(goal.error(), 5 * error) << fmt::format("goal {}, degree {}", f.index(), choice.degree);
    }
  }
}

// Where the two estimates contradict each other, neither is taken alone.
TEST(AGoalsError, LiesBetweenWhatPatchesAndAHigherDegreeSay) {
  GoalEstimate goal{.value = 10, .estimate = -0.8, .contact_edge = 0.2};
  EXPECT_EQ(goal.difference(), -0.8);
  EXPECT_EQ(goal.error(), 1);
  for (const double change : {-3.0, -1.0, -0.5, 0.125, 0.25, 2.0}) {
    goal.at_higher_degree = goal.value + change;
    EXPECT_EQ(goal.difference(), change);
    EXPECT_GE(goal.error(), std::abs(change));
    EXPECT_LE(goal.error(), std::max(1.0, std::abs(change)));
  }
  goal.at_higher_degree = goal.value + 0.125;
  EXPECT_NEAR(goal.error(), 0.25 * std::cbrt(1.36 * 1.36),
              1e-15);  // 1 * 0.125^2 with 1 + 1.8 * 0.2 for the contact's edge
  goal.contact_edge = 0;
  goal.estimate = -1;
  EXPECT_NEAR(goal.error(), 0.25, 1e-15);  // the cube root of 1 * 0.125^2
  goal.contact_edge = 1;
  goal.estimate = 0;
  EXPECT_NEAR(goal.error(), 0.4, 0.1);  // the place of an edge is hardly known better than its own estimate
  EXPECT_GE(goal.error(), 0.4);
  goal.contact_edge = 0.2;
  goal.estimate = -0.8;
  goal.at_higher_degree = goal.value;  // by chance, or because all degrees have the same error
  EXPECT_NEAR(goal.error(), 0.2, 1e-15);
  goal.free_edges = 0.6;  // polynomials do not see these
  EXPECT_NEAR(goal.difference(), 0.6, 1e-15);
  EXPECT_GT(goal.error(), 0.6);
}

/// Clamped at two edges and free at the others. At the free edges the saddle has layers that cells of a quarter of its side do not resolve.
TEST(AGoalsError, HasAPartOfFreeEdges) {
  const GoalEstimate work = SolvedSaddle({.degree = 4, .refinements = 1}).estimate(LoadWork{});
  EXPECT_GT(work.free_edges, 0);
  const GoalEstimate energy = SolvedSaddle({.degree = 4, .refinements = 1}).estimate(Energy{});
  EXPECT_NEAR(energy.free_edges, work.free_edges / 2, 1e-9 * work.free_edges);
}

// Resultants and stresses are linear in the displacements, and von Mises's stress is homogeneous: the value is the dual's load times the solution.
// The derivative of a cell's own value, which other components continue to the point, is right to a thousandth.
TEST(Functionals, OfStressesAreTheirOwnDerivatives) {
  for (const Choice& choice : {Choice{.degree = 2}, Choice{.degree = 4, .refinements = 1},
                               Choice{.degree = 2, .shape = mesh::Shape::triangle, .tying = false}}) {
    SolvedSaddle saddle(choice);
    for (const bool is_smooth : {true, false})
      for (const Functional& f : std::vector<Functional>{
               PointStress{.at = {0.52, 0.37}, .component = 3, .is_smooth = is_smooth},
               PointStress{.at = {0, 0.5}, .component = 6, .axis = Eigen::Vector3d(1, 2, 0), .is_smooth = is_smooth},
               PointStress{.at = {0.52, 0.37}, .kind = StressKind::upper, .component = 2, .is_smooth = is_smooth},
               PointStress{.at = {0.9, 0.37}, .kind = StressKind::von_mises, .is_smooth = is_smooth},
               LargestStress{is_smooth}}) {
        const Derivative d = saddle.derivative_of(f);
        EXPECT_GT(std::abs(d.value), 0);
        EXPECT_NEAR(algebra::dot(d.dual.load, saddle.coordinates()), d.value,
                    (is_smooth ? 1e-9 : 1e-3) * std::abs(d.value))
            << f.index();
      }
  }
}

TEST(Estimates, ShowByTheDualEnergyWhatHasNoLimit) {
  const Eigen::Vector2d at(0.5, 0.5);
  const auto growth = [&](const Functional& f) {
    SolvedSaddle coarse({.degree = 2, .refinements = 2}), fine({.degree = 2, .refinements = 3});
    return fine.estimate(f).dual_energy / coarse.estimate(f).dual_energy;
  };
  EXPECT_LT(growth(LoadWork{}), 1.05);
  EXPECT_LT(growth(PointDisplacement{at, 2}), 1.5);  // as a logarithm
  EXPECT_GT(growth(PointStress{.at = {0.52, 0.37}, .component = 3}), 1.6);
}

TEST(Estimates, AreTheSameHoweverTheCellsAreSpread) {
  const std::vector<Goal> goals{{"energy", Energy{}},
                                {"force", ObstacleForce{}},
                                {"area", ContactArea{}},
                                {"u", PointDisplacement{{0.52, 0.37}, 2}},
                                {"M", PointStress{.at = {0.52, 0.37}, .component = 4}},
                                {"s", PointStress{.at = {0.52, 0.37}, .kind = StressKind::upper, .component = 1}},
                                {"stress", LargestStress{}}};
  Choice choice{.degree = 3, .refinements = 2, .has_obstacle = true};
  SolvedSaddle spread(choice);
  choice.comm = MPI_COMM_SELF;
  SolvedSaddle alone(choice);
  const Estimates a = spread.all(goals), b = alone.all(goals);
  EXPECT_NEAR(a.energy_norm_squared, b.energy_norm_squared, 1e-8 * b.energy_norm_squared);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    EXPECT_NEAR(a.goals[i].value, b.goals[i].value, 1e-9 * std::abs(b.goals[i].value)) << goals[i].name;
    EXPECT_NEAR(a.goals[i].error(), b.goals[i].error(), 1e-5 * b.goals[i].error()) << goals[i].name;
    EXPECT_GT(b.goals[i].error(), 0) << goals[i].name;
  }
}

TEST(Estimates, OfTheCellsAddUpToThatOfTheShell) {
  SolvedSaddle solved({.degree = 2, .refinements = 3});
  const Estimates all = solved.all({});
  double sum = 0;
  for (const double cell : all.cells) {
    EXPECT_GE(cell, 0);
    sum += cell;
  }
  EXPECT_NEAR(algebra::sum_over_ranks(sum, solved.comm()), all.energy_norm_squared, 1e-12 * all.energy_norm_squared);
  EXPECT_GT(all.energy_norm_squared, 0);
}

TEST(GoalNames, AreThoseOfTheResultsAndEachIsThereOnce) {
  const Catalogue catalogue{
      .probes = {{"tip", {0.5, 1}}}, .supports = {"rim"}, .obstacles = {{"table", false}, {"ball", true}}};
  std::vector<std::string> names;
  for (const Goal& goal : all_goals(catalogue)) names.push_back(goal.name);
  for (const char* name : {"energy", "load_work", "reaction", "reaction.z", "contact_area", "probe.tip.u.z",
                           "probe.tip.r.x", "probe.tip.M.11", "probe.tip.Q.2", "support.rim.force",
                           "obstacle.table.force.x", "obstacle.table.area", "obstacle.ball.position"})
    EXPECT_TRUE(find_goal(name, catalogue)) << name;
  EXPECT_FALSE(find_goal("obstacle.table.position", catalogue));
  EXPECT_FALSE(find_goal("reaction", {}));
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(GoalNames, KnowTheirUnits) {
  const Catalogue catalogue{.probes = {{"tip", {0.5, 1}}}};
  EXPECT_EQ(unit_of(find_goal("energy", catalogue)->functional), "J");
  EXPECT_EQ(unit_of(find_goal("probe.tip.M.12", catalogue)->functional), "N");
  EXPECT_EQ(unit_of(find_goal("probe.tip.Q.1", catalogue)->functional), "N/m");
  EXPECT_EQ(unit_of(find_goal("probe.tip.r.y", catalogue)->functional), "rad");
}

TEST(Buckling, IsTheSameOnAnyNumberOfRanks) {
  for (const bool has_obstacle : {false, true}) {
    SolvedSaddle alone({.degree = 3, .refinements = 1, .has_obstacle = has_obstacle, .comm = MPI_COMM_SELF});
    SolvedSaddle shared({.degree = 3, .refinements = 1, .has_obstacle = has_obstacle});
    const double expected = alone.buckling().value();
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(shared.buckling().value(), expected, 0.05 * expected);
  }
}

}  // namespace
}  // namespace plastron::estimation
