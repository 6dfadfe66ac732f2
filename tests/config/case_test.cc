// Good cases are read as the settings that they state.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

#include <cmath>
#include <numbers>

namespace plastron::config {
namespace {

const std::string shell_section = "[shell]\nE = 2.0\nnu = 0.25\nthickness = 0.02\n";
const std::string geometry_section = "[geometry]\ndomain = { disk = { radius = 1 } }\nchart = [\"x\", \"y\", \"0\"]\n";

Case parsed(const std::string& more = "") {
  return parse_case("title = \"t\"\n" + shell_section + geometry_section + more, "case.toml");
}

TEST(Shell, TakesYoungAndPoisson) {
  const auto& material = parsed().problem.shell.sections.common.material;
  EXPECT_DOUBLE_EQ(material.isotropic()->mu, 0.8);
  EXPECT_DOUBLE_EQ(material.isotropic()->lambda, 0.8);
  EXPECT_EQ(material.shear_correction, 1);
}

TEST(Shell, TakesLameConstantsAndAShearCorrection) {
  const Case c =
      parse_case("[shell]\nlambda = \"-1/2\"\nmu = 3\nshear_correction = \"5/6\"\nthickness = \"0.1*(1 + x^2)\"\n" +
                     geometry_section,
                 "case.toml");
  EXPECT_EQ(c.problem.shell.sections.common.material.isotropic()->lambda, -0.5);
  EXPECT_EQ(c.problem.shell.sections.common.material.isotropic()->mu, 3);
  EXPECT_DOUBLE_EQ(c.problem.shell.sections.common.material.shear_correction, 5.0 / 6);
  EXPECT_DOUBLE_EQ(c.problem.shell.sections.common.thickness(2, 7), 0.5);
}

TEST(Constants, MayUseThoseAboveThemInTheOrderOfTheFile) {
  const Case c = parse_case("[constants]\nz = 2\nb = \"z/4\"\na = \"sin(pi*b)\"\n" + shell_section + geometry_section +
                                "[[probe]]\nname = \"p\"\nat = [\"b/2\", \"a - 1\"]\n",
                            "case.toml");
  ASSERT_EQ(c.constants.size(), 3u);
  EXPECT_EQ(c.constants[0], (std::pair<std::string, double>("z", 2)));
  EXPECT_EQ(c.constants[1], (std::pair<std::string, double>("b", 0.5)));
  EXPECT_EQ(c.constants[2].first, "a");
  EXPECT_DOUBLE_EQ(c.constants[2].second, 1);
  EXPECT_EQ(c.problem.probes[0].at[0], 0.25);
}

TEST(Constants, StandInChartsLoadsAndThickness) {
  const Case c = parse_case(
      "[constants]\nR = 2\n[shell]\nE = 1\nnu = 0\nthickness = \"R/100\"\n[geometry]\n"
      "domain = { disk = { radius = \"R/2\" } }\nchart = [\"x\", \"y\", \"R - sqrt(R^2 - x^2 - y^2)\"]\n"
      "[[load]]\nforce = [0, \"x\", \"-R*y\"]\n",
      "case.toml");
  EXPECT_DOUBLE_EQ(c.problem.shell.sections.common.thickness(0, 0), 0.02);
  EXPECT_TRUE(c.problem.shell.sections.common.thickness.is_constant());
  EXPECT_EQ(std::get<domain::Disk>(c.problem.domain).radius, 1);
  const auto jet = c.problem.charts.at("")(0, 0);
  EXPECT_NEAR(jet.dd[0][2], 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(c.problem.shell.loads.on_areas[0].force[2](0, 3), -6);
}

/// A rectangle of the regions a and b, E = 2, density 7.
Case two_regions(const std::string& more) {
  const std::string gravity =
      more.find("[gravity]") == std::string::npos ? "[gravity]\nacceleration = [0, 0, 0]\n" : "";
  return parse_case(
      "[shell]\nE = 2\nnu = 0.25\nthickness = 0.125\nshear_correction = 0.5\ndensity = 7\n[geometry]\n"
      "domain = { rectangle = { to = [2, 1], breaks = [1], regions = [\"a\", \"b\"] } }\n"
      "chart = [\"x\", \"y\", 0]\n" +
          gravity + more,
      "case.toml");
}

TEST(Loads, ActOnTheAreaOrOnABoundary) {
  const auto problem = parsed(
                           "[[load]]\nforce = [0, 0, -1]\n[[load]]\npressure = \"x\"\ncouple = [1, 0, 0]\n"
                           "[[load]]\nboundary = \"rim\"\nforce = [\"y\", 2, 3]\n")
                           .problem;
  ASSERT_EQ(problem.shell.loads.on_areas.size(), 2u);
  EXPECT_EQ(problem.shell.loads.on_areas[0].force[2](0, 0), -1);
  EXPECT_EQ(problem.shell.loads.on_areas[0].pressure(0, 0), 0);
  EXPECT_EQ(problem.shell.loads.on_areas[1].pressure(4, 0), 4);
  EXPECT_EQ(problem.shell.loads.on_areas[1].couple[0](0, 0), 1);
  ASSERT_EQ(problem.shell.loads.on_edges.size(), 1u);
  EXPECT_EQ(problem.shell.loads.on_edges[0].boundary, "rim");
  EXPECT_EQ(problem.shell.loads.on_edges[0].force[0](0, 5), 5);
  EXPECT_EQ(problem.shell.loads.on_edges[0].couple[2](0, 5), 0);
}

TEST(Loads, ActOnRegionsAndOnListsOfBoundaries) {
  const auto problem = two_regions(
                           "[[load]]\nregion = \"b\"\npressure = 1\n[[load]]\nregion = [\"b\", \"a\"]\npressure = 2\n"
                           "[[load]]\nboundary = [\"top\", \"left\"]\nforce = [0, 0, \"x\"]\n")
                           .problem;
  ASSERT_EQ(problem.shell.loads.on_areas.size(), 2u);
  EXPECT_EQ(problem.shell.loads.on_areas[0].regions, std::vector<std::string>{"b"});
  EXPECT_EQ(problem.shell.loads.on_areas[1].regions, (std::vector<std::string>{"b", "a"}));
  ASSERT_EQ(problem.shell.loads.on_edges.size(), 2u);
  EXPECT_EQ(problem.shell.loads.on_edges[0].boundary, "top");
  EXPECT_EQ(problem.shell.loads.on_edges[1].boundary, "left");
  EXPECT_EQ(problem.shell.loads.on_edges[1].force[2](3, 0), 3);
}

TEST(Materials, AreChosenByNameInTheShellAndInItsRegions) {
  const std::string materials = R"case([[material]]
name = "steel"
E = 4
nu = 0.25
[[material]]
name = "ply"
E1 = "2 * 20"
E2 = 10
nu12 = 0.3
G12 = 5
G13 = 6
G23 = 7
direction = [0, 2, 0]
[[material]]
name = "stack"
layers = [{ material = "ply", thickness = 1, angle = 45 }, { material = "steel", thickness = 3, strain = [1e-3, 2e-3, 0] }]
)case";
  const Case c = parse_case(
      materials +
          "[shell]\nmaterial = \"ply\"\nthickness = 0.1\nshear_correction = \"5/6\"\n[geometry]\nchart = [\"x\", "
          "\"y\", 0]\n"
          "domain = { rectangle = { to = [3, 1], cells = [3, 1], breaks = [1, 2], regions = [\"a\", \"b\", \"c\"] } }\n"
          "[[region]]\nname = \"b\"\nmaterial = \"stack\"\n[[region]]\nname = \"c\"\nmaterial = \"steel\"\n",
      "case.toml");
  const auto& [common, regions] = c.problem.shell.sections;
  ASSERT_TRUE(common.material.laminate());
  EXPECT_EQ(common.material.shear_correction, 5.0 / 6);
  const auto& one = common.material.laminate()->layers();
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].material.E1, 40);
  EXPECT_EQ(one[0].material.nu12, 0.3);
  EXPECT_EQ(one[0].material.G23, 7);
  EXPECT_FALSE(common.material.laminate()->has_axes(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(common.material.laminate()->has_axes(Eigen::Vector3d::UnitX()));
  const auto stack = regions.at("b").material.laminate();
  ASSERT_TRUE(stack);
  EXPECT_EQ(regions.at("b").material.shear_correction, 5.0 / 6);
  ASSERT_EQ(stack->layers().size(), 2u);
  EXPECT_DOUBLE_EQ(stack->layers()[0].angle, std::numbers::pi / 4);
  EXPECT_EQ(stack->layers()[1].material.E2, 4);
  EXPECT_EQ(stack->layers()[1].strain, Eigen::Vector3d(1e-3, 2e-3, 0));
  EXPECT_EQ(stack->interface(1), -0.25);
  ASSERT_TRUE(regions.at("c").material.isotropic());
  EXPECT_NEAR(regions.at("c").material.young(), 4, 1e-14);
  EXPECT_EQ(c.effective["material"][2]["layers"][0]["angle"], 45.0);
}

TEST(Regions, HaveOfTheShellWhatTheyDoNotGive) {
  const auto problem = two_regions(
                           "[[region]]\nname = \"b\"\nthickness = \"0.5 + x\"\ndensity = 3\n[[region]]\nname = \"a\"\n"
                           "E = 8\nnu = 0.25\n[gravity]\nacceleration = [0, 1, -2]\n")
                           .problem;
  const auto& [common, regions] = problem.shell.sections;
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_EQ(regions.at("b").thickness(1, 0), 1.5);
  EXPECT_EQ(regions.at("b").material.isotropic()->mu, common.material.isotropic()->mu);
  EXPECT_EQ(regions.at("b").density, 3);
  EXPECT_EQ(regions.at("a").thickness(1, 0), common.thickness(1, 0));
  EXPECT_NEAR(regions.at("a").material.young(), 8, 1e-14);
  EXPECT_EQ(regions.at("a").material.shear_correction, 0.5);
  EXPECT_EQ(regions.at("a").density, 7);
  EXPECT_EQ(common.density, 7);
  EXPECT_EQ(problem.shell.loads.gravity, Eigen::Vector3d(0, 1, -2));
  EXPECT_EQ(parsed().problem.shell.loads.gravity, Eigen::Vector3d(0, 0, 0));
}

TEST(Obstacle, HasAUnitNormal) {
  const auto problem =
      parsed("[[obstacle]]\nhalf_space = { point = [0, 0, 1], normal = [0, 3, -4] }\nface = \"upper\"\n").problem;
  ASSERT_EQ(problem.shell.obstacles.all.size(), 1U);
  EXPECT_EQ(problem.shell.obstacles.all.at(0).face, obstacle::Face::upper);
  EXPECT_EQ(std::get<obstacle::HalfSpace>(problem.shell.obstacles.all.at(0).shape).point, Eigen::Vector3d(0, 0, 1));
  EXPECT_NEAR(
      (std::get<obstacle::HalfSpace>(problem.shell.obstacles.all.at(0).shape).normal - Eigen::Vector3d(0, 0.6, -0.8))
          .norm(),
      0, 1e-15);
  EXPECT_TRUE(parsed().problem.shell.obstacles.empty());
}

TEST(Joins, AreHingesIfTheySaySoOrHaveAStiffness) {
  const auto join = [](const std::string& more) {
    return parse_case(shell_section +
                          "[geometry]\ndomain = { rectangle = { to = [2, 1] } }\nchart = [\"x\", \"y\", \"0\"]\n"
                          "[[join]]\nboundaries = [\"left\", \"right\"]\n" +
                          more,
                      "case.toml")
        .problem.joins.at(0);
  };
  EXPECT_FALSE(join("").is_hinge);
  EXPECT_TRUE(join("hinge = true\n").is_hinge);
  EXPECT_EQ(join("hinge = true\n").stiffness, 0);
  EXPECT_TRUE(join("stiffness = 3\n").is_hinge);
  EXPECT_EQ(join("stiffness = 3\n").stiffness, 3);
}

TEST(MeshAndSolver, TakeWhatTheyAreGiven) {
  const auto problem = parsed(
                           "[mesh]\ndegree = 4\ntying = false\nrefinements = \"2+1\"\n[solver]\nmax_iterations = 7\n"
                           "linear_tolerance = 1e-9\ngap_tolerance = 1e-8\nmultiplier_tolerance = \"1e-7\"\n")
                           .problem;
  EXPECT_EQ(problem.discretisation.degree, 4);
  EXPECT_FALSE(problem.shell.tying);
  EXPECT_EQ(problem.discretisation.refinements, 3);
  EXPECT_EQ(problem.contact.max_iterations, 7);
  EXPECT_EQ(problem.contact.linear_tolerance, 1e-9);
  EXPECT_EQ(problem.contact.gap_tolerance, 1e-8);
  EXPECT_EQ(problem.contact.multiplier_tolerance, 1e-7);
}

TEST(Triangles, AreNotTied) {
  for (const char* mesh : {"cells = \"triangle\"\n", "tying = false\ndegree = 1\ncells = \"triangle\"\n"}) {
    const Case c = parsed(std::string("[mesh]\n") + mesh);
    EXPECT_EQ(c.problem.discretisation.cells, mesh::Shape::triangle);
    EXPECT_FALSE(c.problem.shell.tying);
    EXPECT_EQ(c.effective["mesh"]["tying"], false);
    EXPECT_EQ(c.effective["mesh"]["cells"], "triangle");
  }
  EXPECT_EQ(parsed().problem.discretisation.cells, mesh::Shape::quadrilateral);
}

TEST(Case, WantsAReportUnlessItRefusesIt) {
  EXPECT_TRUE(parsed().wants_report);
  EXPECT_EQ(parsed().effective["output"]["report"], true);
  EXPECT_FALSE(parsed("[output]\nreport = false\n").wants_report);
  EXPECT_TRUE(parsed("[output]\nreport = true\n").wants_report);
}

TEST(Case, KnowsWhetherItStatesItsUnits) {
  EXPECT_FALSE(parsed().problem.output.units.are_stated);
  for (const char* units : {"length = \"m\"", "force = \"N\"", "length = \"mm\""})
    EXPECT_TRUE(parsed(std::string("[units]\n") + units + "\n").problem.output.units.are_stated) << units;
}

TEST(Case, HasWhatFilesOfFieldsAndMomentsAreToBe) {
  const problem::Output plain = parsed().problem.output;
  EXPECT_EQ(plain.solid_layers, 0);
  EXPECT_FALSE(plain.double_precision);
  EXPECT_TRUE(plain.heights.empty());
  EXPECT_EQ(plain.moment_point, Eigen::Vector3d(0, 0, 0));
  const Case c =
      parsed("[output]\nsolid = true\nprecision = \"double\"\nheights = [0.5, -0.25, 0.5]\nmoment_point = [1, 2, 3]\n");
  EXPECT_EQ(c.problem.output.solid_layers, 4);
  EXPECT_TRUE(c.problem.output.double_precision);
  EXPECT_EQ(c.problem.output.heights, (std::vector{-0.25, 0.5}));
  EXPECT_EQ(c.problem.output.moment_point, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(parsed("[output]\nsolid = true\nlayers = 2\n").problem.output.solid_layers, 2);
  EXPECT_EQ(parsed("[output]\nlayers = 2\n").problem.output.solid_layers, 0);
  EXPECT_EQ(c.effective["output"]["precision"], "double");
}

TEST(Effective, HasTheDefaultsInTheShapeOfTheFile) {
  const Case c = parsed();
  const auto& e = c.effective;
  EXPECT_EQ(c.title, "t");
  EXPECT_EQ(e["title"], "t");
  EXPECT_EQ(e["shell"]["E"], 2.0);
  EXPECT_EQ(e["shell"]["shear_correction"], 1.0);
  EXPECT_EQ(e["shell"]["formulation"], "tangent");
  EXPECT_EQ(e["geometry"]["domain"]["disk"]["centre"], nlohmann::json::array({0.0, 0.0}));
  EXPECT_EQ(e["geometry"]["chart"], nlohmann::json::array({"x", "y", "0"}));
  // The accuracy determines the meshes.
  EXPECT_EQ(e["mesh"],
            (nlohmann::json{
                {"cells", "quadrilateral"}, {"degree", 4}, {"tying", true}, {"layers", "auto"}, {"refinements", 0}}));
  EXPECT_EQ(e["accuracy"], (nlohmann::json{{"energy", 1e-3}, {"max_unknowns", 2e6}}));
  EXPECT_EQ(e["solver"]["gap_tolerance"], 1e-11);
  EXPECT_EQ(e["load"], nlohmann::json::array());
}

// JSON as a TOML value on one line.
std::string in_toml(const nlohmann::json& value) {
  const bool list = value.is_array();
  if (!list && !value.is_object()) return value.dump();
  std::string text = list ? "[" : "{";
  for (const auto& [key, entry] : value.items())
    text += (text.size() > 1 ? ", " : "") + (list ? "" : nlohmann::json(key).dump() + " = ") + in_toml(entry);
  return text + (list ? "]" : "}");
}

TEST(Effective, IsACaseOfItsOwnWithTheSameSettings) {
  const Case c = parse_case(
      "[constants]\nb = 2\na = \"1/b\"\n[shell]\nlambda = 1\nmu = 1\nthickness = \"a + x^2\"\ndensity = \"b\"\n"
      "[[region]]\nname = \"two\"\nthickness = \"b*y\"\nE = 3\nnu = 0\n[gravity]\nacceleration = [0, \"-a\", "
      "0]\n[geometry]\n"
      "domain = { rectangle = { to = [2, 1], cells = [4, 2], breaks = [\"a\"], regions = [\"one\", \"two\"] } }\n"
      "chart = { one = [\"x\", \"y\", 0], two = [\"x\", \"y\", \"1e-3*(x - a)^3\"] }\n"
      "[[support]]\nboundary = \"left\"\nfix = [\"symmetry\", \"u.t\", \"r.x\"]\nvalues = { u.t = \"y*a\" }\n"
      "[[support]]\nboundary = \"top\"\nfix = [\"u\"]\nvalues = { u = [0, \"a\", \"x\"] }\n"
      "[[support]]\npoint = [\"a\", 0]\nfix = [\"u.z\", \"u.x\"]\nvalues = { u.x = \"b\" }\n"
      "[[load]]\npressure = \"1/3\"\n[[load]]\nboundary = [\"top\", \"right\"]\ncouple = [0, 0, \"x\"]\n"
      "[[load]]\nregion = [\"one\"]\npressure = 1\n"
      "[[obstacle]]\nhalf_space = { normal = [1, 1, 1] }\n[[probe]]\nname = \"p\"\nat = [\"a/3\", 0.5]\n",
      "case.toml");
  std::string text;
  for (const auto& [key, value] : c.effective.items()) text += key + " = " + in_toml(value) + "\n";
  const Case again = parse_case(text, "effective.toml");
  EXPECT_EQ(again.effective, c.effective) << text;
  EXPECT_EQ(again.problem.shell.sections.common.thickness(1, 0), c.problem.shell.sections.common.thickness(1, 0));
  EXPECT_EQ(again.problem.shell.sections.regions.at("two").thickness(1, 3), 6);
  EXPECT_EQ(c.effective["load"][1]["boundary"], (nlohmann::json{"top", "right"}));
  EXPECT_EQ(c.effective["load"][2]["region"], nlohmann::json::array({"one"}));
  EXPECT_EQ(c.effective["support"][0]["boundary"], "left");
  EXPECT_EQ(c.effective["support"][2]["point"], (nlohmann::json{0.5, 0.0}));
  EXPECT_EQ(again.problem.shell.supports[1].components[2].value(3, 0), 3);
}

}  // namespace
}  // namespace plastron::config
