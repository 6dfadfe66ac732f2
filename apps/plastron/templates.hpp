// The example cases of `plastron new`: the files of the folder templates, embedded in the program at its configuration
// (embed_templates.cmake).
#pragma once
#include <span>
#include <string_view>

namespace plastron::app {

struct EmbeddedFile {
  std::string_view name;  ///< "bowl.toml", "plate-with-hole.msh"
  std::string_view text;
};

/// Returns case files, and other files that they name.
std::span<const EmbeddedFile> template_files();

}  // namespace plastron::app
