// The example cases of `plastron new`: the folder templates and the cases of the gallery, embedded in the program at its
// configuration (embed_templates.cmake).
#pragma once
#include <span>
#include <string_view>

namespace plastron::app {

/// A file of an example. The first file of each example is its case.toml.
struct EmbeddedFile {
  std::string_view collection;  ///< "templates" or "gallery"
  std::string_view example;     ///< "bowl", "tank-in-cradle"
  std::string_view name;        ///< "case.toml", "tank.msh"
  std::string_view text;
};

/// Returns the files of all examples.
std::span<const EmbeddedFile> example_files();

}  // namespace plastron::app
