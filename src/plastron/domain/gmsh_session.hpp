// Gmsh as a library: it meshes what a program draws, and opens no file, because it would execute scripts
// (docs/decisions/0008-mesh-files.md).
#pragma once
#include <gmsh.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::domain {

/// Gmsh's single global state for the duration of one meshing: silent, without the user's settings and start-up
/// files. An error ends the meshing and is logged. Gmsh can throw errors instead, but not out of its parallel regions:
/// that would end the process.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 1);
    gmsh::logger::start();
  }
  ~GmshSession() {
    gmsh::logger::stop();
    gmsh::finalize();
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Throws the first error since the session began.
  static void check() {
    constexpr std::string_view mark = "Error: ";
    std::vector<std::string> log;
    gmsh::logger::get(log);
    for (const std::string& entry : log)
      if (entry.starts_with(mark)) throw std::runtime_error(entry.substr(mark.size()));
  }
};

}  // namespace plastron::domain
