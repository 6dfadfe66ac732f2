// CAD files from the command line: closed forms on true surfaces, thin solids, T-joints, names, units, kept meshes, damage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "cli/part_files.hpp"
#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using nlohmann::json;
using part_files::write_step;
using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string case_of(const std::string& geometry, const std::string& rest, double thickness = 2) {
  return "[units]\nlength = \"mm\"\nforce = \"N\"\n[shell]\nE = 210000\nnu = 0.3\nthickness = " +
         std::to_string(thickness) + "\n[geometry]\n" + geometry + rest;
}

json results_of(const Scratch& scratch, const std::string& text, double patience = 120) {
  scratch.write("part.toml", text);
  const Outcome run = plastron({"run", "part.toml", "--output", "out"}, scratch.path, patience);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return json::parse(text_of(scratch.path / "out" / "results.json"));
}

/// A closed sphere under pressure: u_r = p R^2 (1 - nu) / (2 E e (1 + e^2 / (12 R^2))), exact in Naghdi's model.
TEST(CadFile, ASphereIsTheExactOne) {
  const double R = 10, e = 0.5, E = 210000, nu = 0.3, p = 100;
  const Scratch scratch;
  write_step(scratch.path / "sphere.step", [&] { gmsh::model::occ::addSphere(0, 0, 0, R); });
  const std::string supports =
      "[[support]]\npoint = [0, 0, 10]\nfix = [\"u.x\", \"u.y\"]\n[[support]]\npoint = [0, 0, -10]\nfix = [\"u\"]\n"
      "[[support]]\npoint = [10, 0, 0]\nfix = [\"u.y\"]\n";
  const json results =
      results_of(scratch, case_of("file = \"sphere.step\"\n", supports + "[[load]]\npressure = -100\n", e));
  const double u = p * R * R * (1 - nu) / (2 * E * e * (1 + e * e / (12 * R * R)));
  const double energy = 0.5 * p * 4 * pi * R * R * u;
  EXPECT_NEAR(results["energy"].get<double>(), energy, 1e-7 * energy);
}

/// The same bracket in metres, inches and millimetres, and a file that names a wrong unit.
TEST(CadFile, LengthsAreThoseOfTheCase) {
  const Scratch scratch;
  write_step(scratch.path / "plate.step", [] { gmsh::model::occ::addRectangle(0, 0, 0, 100, 60); });
  const auto area = [&](const std::string& units, const std::string& more) {
    scratch.write("part.toml",
                  units + "[shell]\nE = 1e9\nnu = 0.3\nthickness = 0.01\n[geometry]\nfile = \"plate.step\"\n" + more);
    return plastron({"check", "part.toml"}, scratch.path).output;
  };
  EXPECT_THAT(area("[units]\nlength = \"mm\"\n", ""), HasSubstr("mid-surface area 6000 mm^2"));
  EXPECT_THAT(area("", ""), HasSubstr("mid-surface area 0.006 m^2"));
  EXPECT_THAT(area("[units]\nlength = \"in\"\n", ""), HasSubstr("mid-surface area 9.30002 in^2"));
  EXPECT_THAT(area("", "unit = \"in\"\n"), HasSubstr("mid-surface area 3.87096 m^2"));
  EXPECT_THAT(area("", "scale = 1e-3\n"), HasSubstr("a CAD file has a unit"));
  EXPECT_THAT(area("[units]\nlength = \"furlong\"\n", ""), HasSubstr("cannot be converted to \"furlong\""));
}

/// The rib's edge lies inside the plate: there both are joined, and the plate carries the rib's load.
TEST(CadFile, AnEdgeInsideAFaceIsATJoint) {
  const Scratch scratch;
  write_step(scratch.path / "rib.step", part_files::draw_rib);
  const std::string rest =
      "[[boundary]]\nname = \"ends\"\nedges = { where = \"Z == 0 && (X < 1e-6 || X > 100 - 1e-6)\", free = true }\n"
      "[[boundary]]\nname = \"top\"\nedges = { where = \"Z > h\" }\n"
      "[[support]]\nboundary = \"ends\"\nfix = [\"u\", \"r\"]\n[[load]]\nboundary = \"top\"\ntotal = [0, 30, 0]\n"
      "[constants]\nh = 19.9\n";
  const json results = results_of(scratch, case_of("file = \"rib.step\"\nsize = 8\n", rest));
  const double sum = results["supports"][0]["reaction"]["force"][1];
  EXPECT_NEAR(sum, -30, 1e-8);
  const Outcome parts = plastron({"parts", "rib.step"}, scratch.path);
  EXPECT_THAT(parts.output, AllOf(HasSubstr("branches of three cells"), HasSubstr("face 1"), HasSubstr("face 2"),
                                  HasSubstr("edge 1")));
}

/// The mid-surface of bent sheets of random sizes: its area, and the deflection under a load at the end of a leg.
TEST(CadFile, AThinSolidIsItsMidSurface) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int trial = 0; trial < 3; ++trial) {
    const double e = 0.5 + 2 * part(random), r = (0.6 + 2 * part(random)) * e, a = 30 + 30 * part(random),
                 b = 10 + 20 * part(random);
    const Scratch scratch;
    write_step(scratch.path / "sheet.step", [&] { part_files::draw_bent_sheet(a, b, e, r); });
    const std::string rest = "[[boundary]]\nname = \"foot\"\nedges = { at = [0, " + std::to_string(b / 2) +
                             ", 0] }\n[[boundary]]\nname = \"tip\"\nedges = { at = [" + std::to_string(a) + ", " +
                             std::to_string(b / 2) + ", " + std::to_string(a) +
                             "] }\n[[support]]\nboundary = \"foot\"\nfix = [\"u\", \"r\"]\n"
                             "[[load]]\nboundary = \"tip\"\ntotal = [1, 0, 0]\n";
    const json results = results_of(scratch, case_of("file = \"sheet.step\"\n", rest, e));
    const double straight = a - r - e, radius = r + e / 2, area = b * (2 * straight + pi / 2 * radius);
    const Outcome check = plastron({"check", "part.toml"}, scratch.path);
    EXPECT_THAT(check.output, Not(HasSubstr("thick, and [shell] has")));
    char text[64];
    std::snprintf(text, sizeof text, "mid-surface area %.6g mm^2", area);
    EXPECT_THAT(check.output, HasSubstr(text));
    // Bending of the beam along its middle by the force at the tip: half of F^2 times the integral of arm^2 / EI.
    const double EI = 210000 * b * e * e * e / 12, height = straight + radius;
    double sum = std::pow(straight, 3) / 3 + straight * height * height;  // upright leg and foot
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) {
      const double angle = pi / 2 * (k + 0.5) / steps;
      sum += std::pow(straight + radius * std::sin(angle), 2) * radius * pi / 2 / steps;
    }
    const double energy = sum / (2 * EI);
    // A strip is between a beam and a plate, which is stiffer by 1 / (1 - nu^2).
    EXPECT_GT(results["energy"].get<double>(), 0.9 * energy);
    EXPECT_LT(results["energy"].get<double>(), 1.02 * energy);
  }
}

/// Solids of sheets that end on sheets, of random sizes, against the area of their middles.
TEST(CadFile, RibsReachTheMiddleOfTheirSheet) {
  namespace occ = gmsh::model::occ;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(0, 1);
  const auto fuse = [](int count) {
    gmsh::vectorpair others, fused;
    std::vector<gmsh::vectorpair> map;
    for (int i = 2; i <= count; ++i) others.emplace_back(3, i);
    occ::fuse({{3, 1}}, others, fused, map);
  };
  for (int trial = 0; trial < 2; ++trial) {
    const double e = 1.5 + 2 * part(random), t = 1.5 + part(random), h = 15 + 10 * part(random),
                 R = 25 + 10 * part(random);
    const Scratch scratch;
    const auto check = [&](const std::function<void()>& draw, double area, const char* joint) {
      write_step(scratch.path / "part.step", draw);
      scratch.write("part.toml", case_of("file = \"part.step\"\n", "", e));
      const std::string output = plastron({"check", "part.toml"}, scratch.path).output;
      char text[64];
      std::snprintf(text, sizeof text, "mid-surface area %.6g mm^2", area);
      EXPECT_THAT(output, AllOf(HasSubstr(text), HasSubstr(joint), HasSubstr("in 1 part")))
          << e << " " << t << " " << h;
      EXPECT_THAT(output, Not(HasSubstr("slanted rims")));
    };
    const auto plate = [&] { occ::addBox(0, 0, 0, 100, 60, e); };
    check([&] { plate(), occ::addBox(0, 30, e, 100, t, h), fuse(2); }, 6000 + 100 * (h + e / 2),
          "branches of three cells");
    check([&] { plate(), occ::addBox(20, 30, e, 60, t, h), fuse(2); }, 6000 + 60 * (h + e / 2),
          "branches of three cells");
    check([&] { plate(), occ::addBox(0, 20, e, 100, t, h), occ::addBox(0, 40, e, 100, t, h), fuse(3); },
          6000 + 200 * (h + e / 2), "branches of three cells");
    check([&] { plate(), occ::addBox(0, 30, e, 100, t, h), occ::addBox(0, 10, -h, 100, t, h), fuse(3); },
          6000 + 200 * (h + e / 2), "branches of three cells");
    check([&] { plate(), occ::addBox(0, 30, e, 100, t, h), occ::addBox(0, 0, e + h, 100, 60, e), fuse(3); },
          12000 + 100 * (h + e), "branches of three cells");
    check([&] { plate(), occ::addBox(0, 30, e, 100, t, h), occ::addBox(50, 0, e, t, 60, h), fuse(3); },
          6000 + 160 * (h + e / 2), "branches of three cells");
    const auto bore = [&](int outer) {
      const int inner = occ::addCylinder(0, 0, -1, 0, 0, 62, R);
      gmsh::vectorpair cut;
      std::vector<gmsh::vectorpair> map;
      occ::cut({{3, outer}}, {{3, inner}}, cut, map);
    };
    const double middle = R + e / 2, tube = 2 * pi * middle * 60;
    check(
        [&] {
          occ::addCylinder(0, 0, 0, 0, 0, 60, R + e), occ::addCylinder(0, 0, 30, 0, 0, t, R + e + h), fuse(2);
          bore(1);
        },
        tube + pi * ((R + e + h) * (R + e + h) - middle * middle), "branches of three cells");
    const double y = R * (0.3 + 0.4 * part(random));  // a fin that is not radial
    check(
        [&] {
          occ::addCylinder(0, 0, 0, 0, 0, 60, R + e), occ::addBox(0, y - t / 2, 0, 60, t, 60), fuse(2);
          bore(1);
        },
        tube + 60 * (60 - std::sqrt(middle * middle - y * y)), "branches of three cells");
  }
}

/// [shell] and a region, each right and wrong.
TEST(CadFile, AnotherThicknessThanTheSolidsIsWarnedOf) {
  const Scratch scratch;
  write_step(scratch.path / "sheet.step", [] { part_files::draw_bent_sheet(40, 20, 2, 3); });
  const auto check = [&](double thickness, const std::string& region) {
    scratch.write("part.toml", case_of("file = \"sheet.step\"\n", region, thickness));
    return plastron({"check", "part.toml"}, scratch.path).output;
  };
  const std::string foot = "[[region]]\nname = \"foot\"\nfaces = { at = [10, 10, 0] }\nthickness = ";
  EXPECT_THAT(check(1, ""), HasSubstr("the solid is 2 mm thick"));
  EXPECT_THAT(check(1, ""), HasSubstr("has the thickness 1 mm there"));
  EXPECT_THAT(check(2, ""), Not(HasSubstr("mm thick")));
  EXPECT_THAT(check(2, foot + "3\n"), HasSubstr("has the thickness 3 mm there"));
  EXPECT_THAT(check(2, foot + "2\n"), Not(HasSubstr("mm thick")));
}

/// Whatever stands beside a sheet in the file is meshed, or the file is refused.
TEST(CadFile, NothingBesideASheetVanishes) {
  const Scratch scratch;
  const auto check = [&](const std::function<void()>& draw, const std::string& geometry = "") {
    write_step(scratch.path / "part.step", [&] {
      gmsh::model::occ::addBox(0, 0, 0, 40, 30, 2);
      draw();
    });
    scratch.write("part.toml", case_of("file = \"part.step\"\n" + geometry, ""));
    return plastron({"check", "part.toml"}, scratch.path);
  };
  const Outcome thick = check([] { gmsh::model::occ::addBox(0, 0, 20, 20, 20, 20); });
  EXPECT_EQ(thick.exit_code, 2);
  EXPECT_THAT(thick.output, HasSubstr("1 of its 2 solids are sheets"));
  EXPECT_THAT(check([] { gmsh::model::occ::addRectangle(0, 0, 20, 40, 30); }).output,
              AllOf(HasSubstr("2 of 7 faces"), HasSubstr("in 2 parts"), HasSubstr("area 2400 mm^2")));
  EXPECT_THAT(check([] { gmsh::model::occ::addBox(0, 0, 20, 40, 30, 1); }).output,
              AllOf(HasSubstr("a sheet of 1 mm"), HasSubstr("a sheet of 2 mm"), HasSubstr("area 2400 mm^2")));
  EXPECT_THAT(check([] {}, "offset = 0.5\n").output, HasSubstr("away from the middle"));
}

TEST(CadFile, ThickSolidsAreTheirSkin) {
  const Scratch scratch;
  write_step(scratch.path / "part.step", [] { gmsh::model::occ::addBox(0, 0, 0, 40, 30, 25); });
  scratch.write("part.toml", case_of("file = \"part.step\"\n", ""));
  EXPECT_THAT(plastron({"check", "part.toml"}, scratch.path).output, HasSubstr("the shell is their skin"));
  scratch.write("part.toml", case_of("file = \"part.step\"\nsolids = \"faces\"\n", ""));
  EXPECT_THAT(plastron({"check", "part.toml"}, scratch.path).output, Not(HasSubstr("skin")));
}

/// Two plates that cross at random places and angles: all of both is the shell, with branches of four cells.
TEST(CadFile, PlatesThatCrossAreJoined) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int trial = 0; trial < 4; ++trial) {
    // The same width: the line of crossing ends on borders of both. A smaller one: it ends inside.
    const double width = trial % 2 == 0 ? 40 : 10 + 20 * part(random), y = 5 + 20 * part(random),
                 down = 4 + 8 * part(random);
    const double angle = pi / 2 + (part(random) - 0.5);
    const Scratch scratch;
    write_step(scratch.path / "cross.step", [&] {
      namespace occ = gmsh::model::occ;
      occ::addRectangle(0, 0, 0, 40, 30);
      const int other = occ::addRectangle(0, -down, 0, width, 20);
      occ::rotate({{2, other}}, 0, 0, 0, 1, 0, 0, angle);
      occ::translate({{2, other}}, 0, y, 0);
    });
    scratch.write("part.toml", case_of("file = \"cross.step\"\n", ""));
    char area[64];
    std::snprintf(area, sizeof area, "mid-surface area %.6g mm^2", 40 * 30 + width * 20);
    EXPECT_THAT(plastron({"check", "part.toml"}, scratch.path).output,
                AllOf(HasSubstr(area), HasSubstr("branches of three cells or more"), HasSubstr("in 1 part")));
  }
}

/// A file that states a wrong unit has the same sheet in the stated one.
TEST(CadFile, AStatedUnitScalesTheWholePart) {
  const Scratch scratch;
  write_step(scratch.path / "sheet.step", [] { gmsh::model::occ::addBox(0, 0, 0, 40, 30, 2); });
  for (const auto& [unit, mm] : std::vector<std::pair<const char*, double>>{
           {"m", 1e3}, {"dm", 100}, {"cm", 10}, {"mm", 1}, {"um", 1e-3}, {"in", 25.4}, {"ft", 304.8}}) {
    scratch.write("part.toml", case_of("file = \"sheet.step\"\nunit = \"" + std::string(unit) + "\"\n", "", 2 * mm));
    char area[64];
    std::snprintf(area, sizeof area, "mid-surface area %.6g mm^2", 1200 * mm * mm);
    EXPECT_THAT(plastron({"check", "part.toml"}, scratch.path).output,
                AllOf(HasSubstr("its middle"), Not(HasSubstr("mm thick")), HasSubstr(area)))
        << unit;
  }
}

/// Where the shell is not the middle of the whole solid, the case says so.
TEST(CadFile, RoundRimsAndOverlapsAreWarnedOf) {
  namespace occ = gmsh::model::occ;
  const Scratch scratch;
  const auto check = [&](const std::function<void()>& draw) {
    write_step(scratch.path / "part.step", draw);
    scratch.write("part.toml", case_of("file = \"part.step\"\n", ""));
    return plastron({"check", "part.toml"}, scratch.path).output;
  };
  const auto plate_with = [&](double lower, double upper) {  // radii of a hole
    occ::addBox(0, 0, 0, 40, 30, 2);
    occ::addCone(20, 15, -1, 0, 0, 4, lower, upper);
    gmsh::vectorpair cut;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{3, 1}}, {{3, 2}}, cut, map);
  };
  EXPECT_THAT(check([&] { plate_with(3.5, 6.5); }), HasSubstr("round, chamfered or slanted rims"));
  EXPECT_THAT(check([&] { plate_with(5, 5 + 1e-6); }), Not(HasSubstr("slanted rims")));
  EXPECT_THAT(check([&] {
                occ::addRectangle(0, 0, 0, 40, 30);
                occ::addRectangle(20, 0, 0, 40, 30);
              }),
              AllOf(HasSubstr("area 1800 mm^2"), HasSubstr("600 mm^2 count once")));
}

TEST(CadFile, LengthsOfCurvedEdgesAreExact) {
  const Scratch scratch;
  write_step(scratch.path / "disk.step", [] { gmsh::model::occ::addDisk(0, 0, 0, 5, 5); });
  EXPECT_THAT(plastron({"parts", "disk.step"}, scratch.path).output, HasSubstr("31.4159"));
}

/// The kept mesh is a mesh like others, with the same result; verify reads it and not the part.
TEST(CadFile, TheMeshOfARunIsKept) {
  const Scratch scratch;
  write_step(scratch.path / "tube.step", [] {
    gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 30, 10);
    gmsh::model::occ::synchronize();
    gmsh::model::occ::remove({{3, 1}});
    gmsh::model::occ::remove({{2, 2}, {2, 3}});
  });
  const auto rest = [](const std::string& foot) {
    return "[[support]]\nboundary = \"" + foot +
           "\"\nfix = [\"u\", \"r\"]\n[[load]]\nregion = \"face 1\"\nforce = [0, 0.01, 0]\n";
  };
  const std::string named =
      "[[boundary]]\nname = \"foot\"\nedges = { where = \"Z < 1e-6\", free = true }\n" + rest("foot");
  const double energy = results_of(scratch, case_of("file = \"tube.step\"\n", named, 0.5))["energy"];
  EXPECT_THAT(plastron({"verify", "out"}, scratch.path).output, HasSubstr("PASSED"));
  fs::copy_file(scratch.path / "out" / "solution.msh", scratch.path / "kept.msh");
  const double again = results_of(scratch, case_of("file = \"kept.msh\"\n", rest("foot"), 0.5))["energy"];
  EXPECT_NEAR(again, energy, 1e-10 * energy);
}

/// A force and a moment at a place of a curved face; a point in the air is told.
TEST(CadFile, ALoadActsAtAPlaceInSpace) {
  const Scratch scratch;
  write_step(scratch.path / "cap.step", [] {
    gmsh::model::occ::addSphere(0, 0, 0, 50, 1, 0.5, pi / 2);
    gmsh::model::occ::synchronize();
    gmsh::model::occ::remove({{3, 1}});
    gmsh::model::occ::remove({{2, 2}});
  });
  const auto text = [](double height) {
    return case_of("file = \"cap.step\"\n",
                   "[[boundary]]\nname = \"rim\"\nedges = { where = \"Z < 24\" }\n"
                   "[[support]]\nboundary = \"rim\"\nfix = [\"u\", \"r\"]\n[[load]]\npoint = [0, 30, " +
                       std::to_string(height) + "]\ntotal = [10, -20, 30]\nmoment = [300, 200, -100]\n");
  };
  const json loads = results_of(scratch, text(40))["loads"];
  const double force[] = {10, -20, 30}, moment[] = {300 + 30 * 30 + 40 * 20, 200 + 40 * 10, -100 - 30 * 10};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(loads["force"][k].get<double>(), force[k], 1e-9);
    EXPECT_NEAR(loads["moment"][k].get<double>(), moment[k], 1e-3 * 1700);
  }
  scratch.write("part.toml", text(45));
  const Outcome off = plastron({"run", "part.toml", "--output", "off"}, scratch.path);
  EXPECT_EQ(off.exit_code, 2);
  EXPECT_THAT(off.output, HasSubstr("no place of the shell is nearer than radius = 2"));
}

TEST(CadFile, WrongChoicesAreTold) {
  const Scratch scratch;
  write_step(scratch.path / "rib.step", part_files::draw_rib);
  const auto check = [&](const std::string& geometry, const std::string& rest = "") {
    scratch.write("part.toml", case_of("file = \"rib.step\"\n" + geometry, rest));
    const Outcome outcome = plastron({"check", "part.toml"}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.output;
  };
  EXPECT_THAT(check("faces = \"face 7\"\n"),
              AllOf(HasSubstr("no face \"face 7\""), HasSubstr("\"face 1\", \"face 2\"")));
  EXPECT_THAT(check("faces = { where = \"Z > 100\" }\n"), HasSubstr("finds none of its 2 faces"));
  EXPECT_THAT(check("faces = { where = \"Q > 100\" }\n"), HasSubstr("unknown name \"Q\""));
  EXPECT_THAT(check("faces = { colour = \"red\" }\n"), HasSubstr("\"#ff0000\""));
  EXPECT_THAT(check("faces = {}\n"), HasSubstr("faces has no condition"));
  EXPECT_THAT(check("", "[[boundary]]\nname = \"rim\"\nedges = { where = \"Z > 100\" }\n"),
              HasSubstr("the boundary \"rim\" finds none of its"));
  EXPECT_THAT(
      check("", "[[region]]\nname = \"a\"\nfaces = \"face 1\"\n[[region]]\nname = \"b\"\nfaces = { at = [0, 0, 0] }\n"),
      HasSubstr("the regions \"a\" and \"b\" both have face 1"));
  const auto boundaries = [&](const std::string& list) { return check("", list); };
  const auto edges = [&](const std::string& selector) {
    return check("", "[[boundary]]\nname = \"rim\"\nedges = " + selector + "\n");
  };
  const auto region = [&](const std::string& selector) {
    return check("", "[[region]]\nname = \"pad\"\nfaces = " + selector + "\n");
  };
  // Keys of the other kind of selection, and expressions: one error each.
  for (const std::string& output :
       {edges("{ colour = \"#ff0000\" }"), region("{ free = true }"), region("{ between = [\"face 1\"] }"),
        edges("{ where = \"Z >\" }"), edges("{ where = 3 }"), edges("{ at = [1, 2] }"), edges("{ free = 1 }")}) {
    EXPECT_THAT(output, HasSubstr("error")) << output;
    EXPECT_THAT(output, Not(HasSubstr("has no condition"))) << output;
    EXPECT_THAT(output, Not(HasSubstr("terminate"))) << output;
  }
  EXPECT_THAT(edges("{ at = [0, 0, 0] }"), HasSubstr("is as near to edge 1 as to edge"));
  EXPECT_THAT(region("{ at = [50, 30, 0] }"), HasSubstr("is as near to face 1 as to face 2"));
  EXPECT_THAT(boundaries("[[boundary]]\nname = \"edge 1\"\nedges = \"edge 4\"\n"),
              HasSubstr("has the name of another edge"));
  EXPECT_THAT(check("", "[[region]]\nname = \"face 1\"\nfaces = \"face 2\"\n"),
              HasSubstr("has the name of another face"));
  EXPECT_THAT(boundaries("[[boundary]]\nname = \"a\"\nedges = \"edge 4\"\n[[boundary]]\nname = \"a\"\nedges = "
                         "\"edge 1\"\n"),
              HasSubstr("two [[boundary]] are named \"a\""));
  EXPECT_THAT(check("tolerance = 12\n"), HasSubstr("above a hundredth of the part's diagonal"));
  EXPECT_THAT(check("size = 1e-9\n"), HasSubstr("at most 200000 are made"));
  scratch.write("part.toml", case_of("domain = { rectangle = { to = [1, 1] } }\nchart = [\"x\", \"y\", \"0\"]\n",
                                     "[[boundary]]\nname = \"rim\"\nedges = \"edge 1\"\n"));
  EXPECT_THAT(plastron({"check", "part.toml"}, scratch.path).output, HasSubstr("[geometry] has none"));
}

/// Damaged files end with a message and no crash, within the time of the reader.
TEST(CadFile, DamageIsTold) {
  const Scratch scratch;
  write_step(scratch.path / "good.step", part_files::draw_rib);
  const std::string good = text_of(scratch.path / "good.step");
  scratch.write("part.toml", case_of("file = \"part.step\"\n", ""));
  std::mt19937 random(11);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int trial = 0; trial < 12; ++trial) {
    std::string text = good;
    if (trial % 3 == 0) text.resize(below(text.size()));
    if (trial % 3 == 1)
      for (int k = 0; k < 30; ++k) text[below(text.size())] = static_cast<char>(below(256));
    if (trial % 3 == 2) text.erase(below(text.size() / 2), below(text.size() / 2));
    scratch.write("part.step", text);
    const Outcome outcome = plastron({"check", "part.toml"}, scratch.path);
    EXPECT_FALSE(outcome.timed_out);
    EXPECT_THAT(outcome.exit_code, testing::AnyOf(0, 2)) << outcome.output;
    EXPECT_THAT(outcome.output, testing::AnyOf(HasSubstr("part.step"), HasSubstr("mesh in space"))) << outcome.output;
  }
}

TEST(CadFile, WithoutTheReaderTheProgramSaysSo) {
  const Scratch scratch;
  write_step(scratch.path / "rib.step", part_files::draw_rib);
  scratch.write("part.toml", case_of("file = \"rib.step\"\n", ""));
  const Outcome outcome = shell("PLASTRON_CAD=/nowhere/plastron-cad $PLASTRON check part.toml", scratch.path);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("plastron-cad, which is not there"));
}

}  // namespace
}  // namespace plastron::cli
