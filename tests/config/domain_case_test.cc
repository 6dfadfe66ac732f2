// [geometry]: the domains and their charts.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

#include <filesystem>
#include <fstream>

namespace plastron::config {
namespace {

problem::Problem with_domain(const std::string& domain, const std::string& chart = "[\"x\", \"y\", \"0\"]",
                             const std::string& file = "case.toml") {
  return parse_case(
             "[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\ndomain = " + domain + "\nchart = " + chart + "\n",
             file)
      .problem;
}

TEST(DomainOfTheCase, IsARectangle) {
  const auto r = std::get<domain::Rectangle>(
      with_domain("{ rectangle = { from = [-1, 0], to = [2, \"1/2\"], cells = [6, 1] } }").domain);
  EXPECT_EQ(r.from, Eigen::Vector2d(-1, 0));
  EXPECT_EQ(r.to, Eigen::Vector2d(2, 0.5));
  EXPECT_EQ(r.cells, (std::array{6, 1}));
  EXPECT_TRUE(r.breaks.empty() && r.regions.empty());
}

TEST(DomainOfTheCase, IsARectangleOfRegionsWithAChartEach) {
  const std::string domain = "{ rectangle = { to = [3, 1], breaks = [1, 2], regions = [\"a\", \"b\", \"c\"] } }";
  const auto problem =
      with_domain(domain, "{ a = [\"x\", \"y\", 0], b = [\"x\", \"y\", 1], c = [\"x\", \"y\", \"x\"] }");
  EXPECT_EQ(std::get<domain::Rectangle>(problem.domain).breaks, (std::vector<double>{1, 2}));
  EXPECT_EQ(std::get<domain::Rectangle>(problem.domain).cells, (std::array{0, 0}));
  EXPECT_EQ(problem.charts.size(), 3u);
  EXPECT_EQ(problem.charts.at("b")(0, 0).value[2], 1);
  EXPECT_EQ(problem.charts.at("c")(5, 0).value[2], 5);
}

TEST(ChartOfTheCase, HoldsForAllRegionsWhenThereIsOne) {
  const auto problem = with_domain("{ rectangle = { to = [2, 1], breaks = [1], regions = [\"a\", \"b\"] } }");
  EXPECT_EQ(problem.charts.size(), 1u);
  EXPECT_TRUE(problem.charts.count(""));
}

TEST(DomainOfTheCase, IsADiskOrAnAnnulus) {
  const auto disk = std::get<domain::Disk>(with_domain("{ disk = { centre = [1, 2], radius = 3 } }").domain);
  EXPECT_EQ(disk.centre, Eigen::Vector2d(1, 2));
  EXPECT_EQ(disk.radius, 3);
  const auto annulus = std::get<domain::Annulus>(with_domain("{ annulus = { inner = 1, outer = 2.5 } }").domain);
  EXPECT_EQ(annulus.centre, Eigen::Vector2d(0, 0));
  EXPECT_EQ(annulus.inner, 1);
  EXPECT_EQ(annulus.outer, 2.5);
}

TEST(DomainOfTheCase, IsAPolygonWrittenEitherWay) {
  for (const char* text :
       {"{ polygon = [[0, 0], [1, 0], [1, 1]] }", "{ polygon = { corners = [[0, 0], [1, 0], [1, 1]] } }"}) {
    const auto polygon = std::get<domain::Polygon>(with_domain(text).domain);
    ASSERT_EQ(polygon.corners.size(), 3u);
    EXPECT_EQ(polygon.corners[2], Eigen::Vector2d(1, 1));
  }
}

TEST(DomainOfTheCase, MayBeANonConvexPolygonInEitherSense) {
  EXPECT_NO_THROW(with_domain("{ polygon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]] }"));
  EXPECT_NO_THROW(with_domain("{ polygon = [[0, 2], [1, 2], [1, 1], [2, 1], [2, 0], [0, 0]] }"));
}

TEST(DomainOfTheCase, IsAMeshFileBesideTheCaseFile) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "plastron-config-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "plate.msh") << "$MeshFormat\n";
  const auto problem =
      with_domain("{ mesh = \"plate.msh\" }", "{ wing = [\"x\", \"y\", 0] }", (folder / "case.toml").string());
  EXPECT_EQ(std::get<domain::MeshFile>(problem.domain).path, (folder / "plate.msh").string());
  EXPECT_EQ(problem.charts.count("wing"), 1u);
  EXPECT_EQ(
      with_domain("{ mesh = \"plate.msh\" }", "[\"x\", \"y\", 0]", (folder / "case.toml").string()).charts.count(""),
      1u);
  // The cells of a file are not refined unless the case says so.
  for (const auto& [mesh, refinements] : {std::pair("degree = 2", 0), {"refinements = 2", 2}})
    EXPECT_EQ(with_domain("{ mesh = \"plate.msh\" }", std::string("[\"x\", \"y\", 0]\n[mesh]\n") + mesh,
                          (folder / "case.toml").string())
                  .discretisation.refinements,
              refinements);
  std::filesystem::remove_all(folder);
}

TEST(DomainOfTheCase, MayBeWrittenAsSections) {
  const Case c = parse_case(
      "[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\nchart = [\"x\", \"y\", 0]\n"
      "[geometry.domain.disk]\nradius = 2\n",
      "case.toml");
  EXPECT_EQ(std::get<domain::Disk>(c.problem.domain).radius, 2);
}

TEST(DomainNames, AreThoseOfTheManual) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(domain::boundary_names(domain::Rectangle{}), (Names{"left", "right", "bottom", "top"}));
  EXPECT_EQ(domain::boundary_names(domain::Disk{}), Names{"rim"});
  EXPECT_EQ(domain::boundary_names(domain::Annulus{}), (Names{"inner", "outer"}));
  EXPECT_EQ(domain::boundary_names(domain::Polygon{{{0, 0}, {1, 0}, {0, 1}}}), (Names{"edge1", "edge2", "edge3"}));
  EXPECT_TRUE(domain::boundary_names(domain::MeshFile{}).empty());
  EXPECT_EQ(domain::region_names(domain::Rectangle{}), Names{""});
  EXPECT_EQ(domain::region_names(domain::Rectangle{.breaks = {0.5}, .regions = {"a", "b"}}), (Names{"a", "b"}));
  EXPECT_TRUE(domain::region_names(domain::MeshFile{}).empty());
}

problem::Problem with_imperfections(const std::string& geometry, const std::string& imperfections) {
  return parse_case("[constants]\nA = 0.25\n[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\n" + geometry + "\n" +
                        imperfections,
                    PLASTRON_TESTS_DIR "/config/case.toml")
      .problem;
}

TEST(ImperfectionsOfTheCase, InParametersArePartsOfTheChart) {
  const problem::Problem p =
      with_imperfections("domain = { rectangle = { to = [2, 1] } }\nchart = [\"x\", \"y\", 0]",
                         "[[imperfection]]\nnormal = \"A*x^2\"\n[[imperfection]]\ndisplacement = [0, \"x*y\", 3]\n");
  EXPECT_TRUE(p.imperfections.empty());
  const geometry::SurfaceJet jet = p.charts.at("")(2, 1);
  EXPECT_EQ(jet.value, geometry::Vector3d(2, 3, 4));
  EXPECT_EQ(jet.d[0], geometry::Vector3d(1, 1, 1));
  EXPECT_EQ(jet.dd[0], geometry::Vector3d(0, 0, 0.5));
}

TEST(ImperfectionsOfTheCase, OfAMeshInSpaceAreFunctionsOfThePlace) {
  const problem::Problem p =
      with_imperfections("file = \"../../cases/tank-in-cradle/tank.msh\"",
                         "[[imperfection]]\nnormal = \"A*X*Y\"\n[[imperfection]]\ndisplacement = [0, \"Z\", 3]\n");
  ASSERT_EQ(p.imperfections.size(), 2U);
  EXPECT_EQ(p.imperfections[0].normal->value({2, 3, 0}), 1.5);
  EXPECT_EQ(p.imperfections[1].displacement[1]->value({0, 0, 7}), 7);
}

TEST(ImperfectionsOfTheCase, HaveTheShapeOfAModeInAFile) {
  const problem::Problem p = with_imperfections("domain = { rectangle = { to = [2, 1] } }\nchart = [\"x\", \"y\", 0]",
                                                "[[imperfection]]\nmode = \"CMakeLists.txt\"\namplitude = \"-A/10\"\n");
  ASSERT_EQ(p.imperfections.size(), 1U);
  EXPECT_EQ(p.imperfections[0].mode_file, PLASTRON_TESTS_DIR "/config/CMakeLists.txt");
  EXPECT_EQ(p.imperfections[0].amplitude, -0.025);
}

}  // namespace
}  // namespace plastron::config
