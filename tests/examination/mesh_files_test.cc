// Mesh files: their coordinates have few digits and no unit, and facets know their normals to some degrees only.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "computation/problems.hpp"
#include "examination/findings.hpp"

namespace plastron::examination {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A sector of a sphere or of a plane ring round the Z axis. Its boundary "end" goes out of its plane by `slope`, an angle in
/// degrees that changes along it.
struct Sector {
  double angle = 60;  ///< [degrees]
  int order = 1;
  int digits = 6;
  bool is_flat = false;
  double slope = 0;

  Eigen::Vector3d point(double along, double across) const {
    const double phi = (angle * along) * std::numbers::pi / 180, polar = (20 + 60 * across) * std::numbers::pi / 180;
    const double radius = is_flat ? 0.2 + across : std::sin(polar), height = is_flat ? 0 : std::cos(polar);
    const double turned = phi + along * slope * std::numbers::pi / 180 * across * across;
    return {radius * std::cos(turned), radius * std::sin(turned), height};
  }

  std::string text() const {
    constexpr int cells = 5;
    const int last = cells * order;
    const auto node = [&](int i, int j) { return 1 + i + (last + 1) * j; };
    std::string nodes, elements;
    for (int j = 0; j <= last; ++j)
      for (int i = 0; i <= last; ++i) {
        const Eigen::Vector3d x = point(static_cast<double>(i) / last, static_cast<double>(j) / last);
        nodes += fmt::format("{} {:.{}g} {:.{}g} {:.{}g}\n", node(i, j), x[0], digits, x[1], digits, x[2], digits);
      }
    int count = 0;
    const auto line = [&](int group, int i, int j, int di, int dj) {
      elements += fmt::format("{} {} 2 {} {} {} {}", ++count, order == 1 ? 1 : 8, group, group, node(i, j),
                              node(i + order * di, j + order * dj));
      elements += order == 1 ? "\n" : fmt::format(" {}\n", node(i + di, j + dj));
    };
    for (int c = 0; c < last; c += order) {
      line(1, 0, c, 0, 1);
      line(2, last, c, 0, 1);
      line(3, c, last, 1, 0);
      for (int i = 0; i < last; i += order) {
        elements += fmt::format("{} {} 2 4 4", ++count, order == 1 ? 3 : 10);
        const int o = order;
        for (const auto& [a, b] : {std::pair(0, 0), {o, 0}, {o, o}, {0, o}})
          elements += fmt::format(" {}", node(i + a, c + b));
        if (order == 2)
          for (const auto& [a, b] : {std::pair(1, 0), {2, 1}, {1, 2}, {0, 1}, {1, 1}})
            elements += fmt::format(" {}", node(i + a, c + b));
        elements += "\n";
      }
    }
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 \"begin\"\n1 2 \"end\"\n1 3 \"rim\"\n2 4 "
           "\"shell\"\n"
           "$EndPhysicalNames\n" +
           fmt::format("$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n", (last + 1) * (last + 1), nodes,
                       count, elements);
  }
};

/// Calls `examined` with a problem on the sector, whose file exists so long.
template <class Examined>
auto on_file(const Sector& sector, double offset, const Examined& examined) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("plastron-sector-{}.msh", getpid());
  std::ofstream(path) << sector.text();
  problem::Problem p;
  p.shell.sections.common = {.thickness = geometry::Expression(0.01)};
  domain::SpaceReading reading;
  reading.symmetric = {"begin", "end"};
  reading.offset = {.part = offset, .thickness = geometry::Expression(0.01)};
  p.domain = domain::MeshFile{.path = path.string(), .in_space = std::move(reading)};
  p.discretisation = {.degree = 2, .refinements = 0};
  p.shell.supports = {test::symmetry("begin"), test::symmetry("end"), test::held("rim", {assembly::Direction::z})};
  auto found = examined(p);
  std::filesystem::remove(path);
  return found;
}

std::vector<std::string> errors_of_symmetry(const Sector& sector, double offset) {
  return on_file(sector, offset, errors);
}

/// A file has no unit. A part of hundreds of metres may be one of millimetres, unless the case names its units.
TEST(MeshFile, IsTakenForOneInMillimetresOnlyWhereTheCaseNamesNoUnit) {
  for (const double scale : {1.0, 1e3})
    for (const problem::UnitNames& units :
         {problem::UnitNames{}, problem::UnitNames{"m", "N", true}, problem::UnitNames{"mm", "N", true},
          problem::UnitNames{"in", "lbf", true}}) {
      const auto found = on_file({}, 0, [&](problem::Problem& p) {
        std::get<domain::MeshFile>(p.domain).in_space->scale = scale;
        p.output.units = units;
        return warnings(p);
      });
      EXPECT_EQ(testing::Value(found, testing::Contains(HasSubstr("if the file is in millimetres"))),
                scale == 1e3 && !units.are_stated)
          << scale << units.label("m");
    }
}

TEST(Symmetry, HoldsOnFilesOfAnyOrderNumberOfDigitsAndOffset) {
  for (const double angle : {35.0, 60.0, 90.0})
    for (const int order : {1, 2})
      for (const int digits : {5, 6, 7, 16})
        for (const bool is_flat : {false, true})
          for (const double offset : {0.0, 0.5, -0.5})
            EXPECT_THAT(errors_of_symmetry({angle, order, digits, is_flat}, offset), testing::IsEmpty())
                << angle << " degrees, order " << order << ", digits " << digits << ", flat " << is_flat << ", offset "
                << offset;
}

TEST(Symmetry, IsRefusedBeyondWhatTheMeshKnows) {
  for (const int order : {1, 2})
    for (const bool is_flat : {false, true})
      for (const double offset : {0.0, 0.5})
        EXPECT_THAT(errors_of_symmetry({.order = order, .digits = 16, .is_flat = is_flat, .slope = 5}, offset),
                    testing::Contains(AllOf(HasSubstr("\"end\" is no symmetry plane"), HasSubstr("degrees (at"),
                                            HasSubstr("degrees, the accuracy of directions in this mesh"))))
            << "order " << order << ", flat " << is_flat << ", offset " << offset;
}

/// The surface of a turned box, as facets.
std::string box_facets(const Eigen::Vector3d& sides, double scale) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::string text = "solid\n";
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, 1}) {
      const auto corner = [&](int i, int j) {
        Eigen::Vector3d x;
        x[axis] = end * sides[axis];
        x[(axis + 1) % 3] = (end == 1 ? i : j) * sides[(axis + 1) % 3];
        x[(axis + 2) % 3] = (end == 1 ? j : i) * sides[(axis + 2) % 3];
        return Eigen::Vector3d(scale * turn * x);
      };
      for (const auto& [b, c] : {std::pair(corner(1, 0), corner(1, 1)), {corner(1, 1), corner(0, 1)}}) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const Eigen::Vector3d& x : {corner(0, 0), b, c})
          text += fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
        text += "endloop\nendfacet\n";
      }
    }
  return text + "endsolid\n";
}

TEST(MeshFile, ThatIsTheSkinOfAThinSolidIsWarnedOf) {
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const auto& [sides, is_skin] : {std::pair(Eigen::Vector3d(60, 60, 1), true),
                                         {Eigen::Vector3d(1.5, 100, 50), true},
                                         {Eigen::Vector3d(60, 60, 20), false},
                                         {Eigen::Vector3d(100, 5, 5), false},
                                         {Eigen::Vector3d(200, 5, 3), false}}) {
      const std::filesystem::path path =
          std::filesystem::temp_directory_path() / fmt::format("plastron-skin-{}.stl", getpid());
      std::ofstream(path) << box_facets(sides, scale);
      domain::SpaceReading reading;
      reading.size = scale * sides.maxCoeff() / 10;
      const auto surface = domain::read_surface({.path = path.string(), .in_space = reading}, {});
      std::filesystem::remove(path);
      std::vector<std::string> warnings;
      for (const Finding& finding : surface_findings(surface, true))
        if (finding.severity == Severity::warning) warnings.push_back(finding.text);
      EXPECT_EQ(testing::Value(warnings, testing::Contains(HasSubstr("skin of a thin solid"))), is_skin)
          << sides.transpose() << " times " << scale;
    }
}

}  // namespace
}  // namespace plastron::examination
