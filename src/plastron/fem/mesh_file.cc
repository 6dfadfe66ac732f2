// Reads Gmsh's mesh files, formats 2.0 to 2.2 and 4.1 as text. Gmsh itself would execute any file of unknown format
// as a script (docs/decisions/0008-mesh-files.md).
#include <plastron/fem/coarse_mesh.hpp>
#include <plastron/fem/mesh_build.hpp>
#include <plastron/fem/mesh_sections.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <variant>

namespace plastron::fem {

namespace {

class Reader {
 public:
  explicit Reader(const std::string& path) : text_(path) { data_.source = path; }

  MeshData read() {
    const bool is_version_2 = header();
    if (is_version_2)
      sections(Version2{text_, data_});
    else
      sections(Version4{text_, data_});
    for (const char* needed : {"Nodes", "Elements"})
      if (!seen_.contains(needed)) throw DomainError(fmt::format("{}: it has no section ${}", text_.path(), needed));
    number_nodes(data_);
    return std::move(data_);
  }

 private:
  /// Reads the header. Returns true for version 2, false for version 4.
  bool header() {
    if (!text_.next_line()) throw DomainError(fmt::format("{}: the mesh file is empty", text_.path()));
    if (text_.line() != "$MeshFormat")
      text_.refuse(
          fmt::format("it is no Gmsh mesh file: it begins with \"{}\" and not with $MeshFormat; save the mesh "
                      "as .msh",
                      shown(text_.line())));
    text_.expect_line("the version of the format");
    const std::string version(text_.word("the version of the format"));
    const std::int64_t is_binary = text_.integer("0 for text or 1 for binary");
    const bool is_version_2 = version == "2" || version == "2.0" || version == "2.1" || version == "2.2";
    if (!is_version_2 && version != "4.1")
      text_.refuse(
          fmt::format("its format has the version {}; 2.2 and 4.1 are read: save it with Mesh.MshFileVersion = "
                      "4.1",
                      shown(version)));
    if (is_binary != 0) text_.refuse("it is a binary file; save it as ASCII: Mesh.Binary = 0");
    end("MeshFormat");
    return is_version_2;
  }

  template <class Version>
  void sections(Version version) {
    while (text_.next_line()) {
      if (text_.line().front() != '$' || text_.line().starts_with("$End"))
        text_.refuse(fmt::format("found \"{}\" where a section should begin, like $Nodes", shown(text_.line())));
      const std::string name(text_.line().substr(1));
      if (!seen_.insert(name).second && is_read(name)) text_.refuse(fmt::format("there is a second section ${}", name));
      if (name == "PartitionedEntities")
        text_.refuse("the mesh is partitioned; save it whole, Plastron divides it itself");
      if (name == "Entities" && seen_.contains("Elements")) text_.refuse("$Entities must stand before $Elements");
      if (!read_section(version, name)) skip(name);
    }
  }

  static bool is_read(const std::string& name) {
    return name == "PhysicalNames" || name == "Nodes" || name == "Elements" || name == "Entities";
  }

  template <class Version>
  bool read_section(Version& version, const std::string& name) {
    if constexpr (std::is_same_v<Version, Version2>) {
      if (name == "Entities") return false;
    } else {
      if (name == "Entities") version.entities();
    }
    if (name == "PhysicalNames") read_names(text_, data_);
    if (name == "Nodes") version.nodes();
    if (name == "Elements") version.elements();
    if (!is_read(name)) return false;
    end(name);
    return true;
  }

  void end(const std::string& name) {
    const std::string line = "$End" + name;
    text_.expect_line(line.c_str());
    if (text_.line() != line)
      text_.refuse(fmt::format("found \"{}\" where {} should follow", shown(text_.line()), line));
  }

  void skip(const std::string& name) {
    const std::size_t opened = text_.line_number();
    while (text_.next_line())
      if (text_.line().starts_with("$End") && text_.line().substr(4) == name) return;
    text_.refuse(fmt::format("the section ${}, opened in line {}, has no end", shown(name), opened));
  }

  MeshText text_;
  MeshData data_;
  std::set<std::string> seen_;
};

}  // namespace

CoarseMesh read_mesh_file(const MeshFile& file, Shape shape) {
  return build_coarse_mesh(Reader(file.path).read(), shape);
}

}  // namespace plastron::fem
