// Mesh files that tests write: a square in format 2.2 by its sections, and the reader's answer to a text.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>
#include <plastron/domain/domain_mesh.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace plastron::domain::written {

/// A name of this process in the folder for temporary files. The file is removed at the end.
struct TemporaryPath {
  explicit TemporaryPath(const std::string& ending)
      : path(std::filesystem::temp_directory_path() / ("plastron-" + std::to_string(getpid()) + ending)) {}
  ~TemporaryPath() { std::filesystem::remove(path); }
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  std::filesystem::path path;
};

inline mesh::CoarseMesh read(const std::string& name, mesh::Shape shape = mesh::Shape::quadrilateral) {
  return coarse_mesh(MeshFile{std::string(PLASTRON_TESTS_DIR "/domain/data/") + name}, shape);
}

inline const std::string header = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
inline const std::string names = "$PhysicalNames\n2\n1 1 \"edge\"\n2 2 \"plate\"\n$EndPhysicalNames\n";
inline const std::string square = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
inline const std::string edges = "1 1 2 1 1 1 2\n2 1 2 1 2 2 3\n3 1 2 1 3 3 4\n4 1 2 1 4 4 1\n";
inline const std::string cell = "$Elements\n5\n" + edges + "5 3 2 2 1 1 2 3 4\n$EndElements\n";

inline mesh::CoarseMesh read_text(const std::string& text, mesh::Shape shape = mesh::Shape::quadrilateral) {
  const TemporaryPath path(".msh");
  std::ofstream(path.path) << text;
  return coarse_mesh(MeshFile{path.path.string()}, shape);
}

inline std::string refusal(const std::string& text, mesh::Shape shape = mesh::Shape::quadrilateral) {
  try {
    read_text(text, shape);
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

}  // namespace plastron::domain::written
