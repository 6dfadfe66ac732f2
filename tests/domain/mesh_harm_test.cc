// Files that are not meshes: a script, a pipe, a device, infinite counts, damage. Each gets one message with the place
// and the mistake. None is executed, hangs or fills the memory.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "domain/written_mesh.hpp"

namespace plastron::domain {
namespace {

using namespace written;
using testing::AllOf;
using testing::HasSubstr;

std::string refusal_of_path(const std::string& path) {
  try {
    coarse_mesh(MeshFile{path}, mesh::Shape::quadrilateral);
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(HarmfulMeshFile, with_a_script_is_refused_and_not_carried_out) {
  const TemporaryPath trace(".trace");
  const std::string script = "SystemCall \"touch " + trace.path.string() + "\";\n";
  EXPECT_THAT(refusal(script), AllOf(HasSubstr("line 1"), HasSubstr("no Gmsh mesh file"), HasSubstr("SystemCall")));
  refusal("Exit;\n");
  refusal("\n\n// comment\n" + script);
  refusal(header + script + names + square + cell);
  refusal(header + names + square + cell + script);
  EXPECT_FALSE(std::filesystem::exists(trace.path));
}

TEST(HarmfulMeshFile, that_is_a_part_is_refused_with_its_right_name) {
  EXPECT_THAT(refusal("ISO-10303-21;\nHEADER;\n"), AllOf(HasSubstr("STEP"), HasSubstr("file = \"part.step\"")));
  for (const char* first : {"DBRep_DrawableShape\n", "CASCADE Topology V1, (c) Matra-Datavision\n"})
    EXPECT_THAT(refusal(first), AllOf(HasSubstr("BREP"), HasSubstr("file = \"part.brep\"")));
}

TEST(HarmfulMeshFile, that_is_a_pipe_a_device_or_a_folder_is_refused_at_once) {
  const TemporaryPath pipe(".pipe");
  ASSERT_EQ(mkfifo(pipe.path.c_str(), 0600), 0);
  EXPECT_THAT(refusal_of_path(pipe.path.string()), HasSubstr("no regular file"));
  EXPECT_THAT(refusal_of_path("/dev/zero"), HasSubstr("no regular file"));
  EXPECT_THAT(refusal_of_path(std::filesystem::temp_directory_path().string()), HasSubstr("no regular file"));
}

TEST(HarmfulMeshFile, that_is_too_large_is_refused_unread) {
  const TemporaryPath path(".msh");
  std::ofstream(path.path) << header;
  std::filesystem::resize_file(path.path, std::uintmax_t{1} << 40);  // a hole, no bytes on the disk
  EXPECT_THAT(refusal_of_path(path.path.string()), HasSubstr("256 MB"));
}

TEST(HarmfulMeshFile, cannot_promise_more_than_it_holds) {
  EXPECT_THAT(refusal(header + "$Nodes\n1000000000000000\n1 0 0 0\n$EndNodes\n"),
              AllOf(HasSubstr("line 5"), HasSubstr("1000000000000000"), HasSubstr("bytes follow")));
  EXPECT_THAT(refusal(header + "$Nodes\n-1\n1 0 0 0\n$EndNodes\n"), HasSubstr("-1"));
  EXPECT_THAT(refusal(header + square + "$Elements\n999999999\n1 3 2 2 1 1 2 3 4\n"), HasSubstr("bytes follow"));
  const std::string header_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  EXPECT_THAT(refusal(header_4 + "$Entities\n0 0 1 0\n1 0 0 0 1 1 0 4000000000 1\n$EndEntities\n"),
              HasSubstr("bytes follow"));
  EXPECT_THAT(refusal(header_4 + "$Nodes\n1 4 1 4\n2 1 0 88888888888\n1\n2\n$EndNodes\n"), HasSubstr("bytes follow"));
}

TEST(DamagedMeshFile, is_refused_with_its_line_and_what_stands_there) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = header + names + square + cell;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal(changed("3 1 1 0\n", "3 1 one 0\n")), AllOf(HasSubstr("line 13"), HasSubstr("\"one\"")));
  EXPECT_THAT(refusal(changed("3 1 1 0\n", "3 1 nan 0\n")), AllOf(HasSubstr("line 13"), HasSubstr("\"nan\"")));
  EXPECT_THAT(refusal(changed("3 1 1 0\n", "3 1 1\n")), AllOf(HasSubstr("line 13"), HasSubstr("coordinate")));
  EXPECT_THAT(refusal(changed("3 1 1 0\n", "2 1 1 0\n")), HasSubstr("node 2 stands twice"));
  EXPECT_THAT(refusal(changed("5 3 2 2 1 1 2 3 4", "5 3 2 2 1 1 2 3")),
              AllOf(HasSubstr("line 22"), HasSubstr("element 5")));
  EXPECT_THAT(refusal(changed("5 3 2 2 1 1 2 3 4", "5 3 2 2 1 1 2 3 9")),
              AllOf(HasSubstr("element 5 (line 22)"), HasSubstr("node 9")));
  EXPECT_THAT(refusal(changed("5 3 2 2 1", "5 999 2 2 1")), HasSubstr("type 999"));
  EXPECT_THAT(refusal(changed("$EndNodes", "$EndNode")), AllOf(HasSubstr("line 15"), HasSubstr("$EndNodes")));
  EXPECT_THAT(refusal(changed("$EndElements\n", "")), HasSubstr("$EndElements"));
  EXPECT_THAT(refusal(header + names + square), HasSubstr("no section $Elements"));
  EXPECT_THAT(refusal(header + names + square + square + cell), HasSubstr("second section $Nodes"));
}

TEST(DamagedMeshFile, shows_no_control_characters) {
  const std::string message =
      refusal("\x1b[31mred\x07 and much more text than anybody would like to read in a message\n");
  EXPECT_THAT(message, HasSubstr("?[31mred? and"));
  EXPECT_LT(message.size(), 300u);
  EXPECT_THAT(refusal(header + "$PhysicalNames\n1\n1 1 \"\x1b[2J\"\n$EndPhysicalNames\n"),
              HasSubstr("cannot be printed"));
  EXPECT_THAT(refusal(header + "$PhysicalNames\n1\n1 1 \"\xff\xfe\"\n$EndPhysicalNames\n"),
              HasSubstr("cannot be printed"));
}

TEST(MeshFormat, of_other_kinds_is_told_how_to_save_it) {
  EXPECT_THAT(refusal("$MeshFormat\n4.1 1 8\n\x01"), HasSubstr("Mesh.Binary = 0"));
  EXPECT_THAT(refusal("$MeshFormat\n4 0 8\n$EndMeshFormat\n"), HasSubstr("Mesh.MshFileVersion = 4.1"));
  EXPECT_THAT(refusal("$NOD\n1\n1 0 0 0\n$ENDNOD\n"), HasSubstr("format 1.0"));
}

}  // namespace
}  // namespace plastron::domain
