// The starter cases of `plastron new`: the files of the folder templates, taken into the program when it is configured
// (embed_templates.cmake).
#pragma once
#include <span>
#include <string_view>

namespace plastron::app {

struct EmbeddedFile {
  std::string_view name;  ///< "bowl.toml", "plate-with-hole.msh"
  std::string_view text;
};

/// Case files, and other files that they name.
std::span<const EmbeddedFile> template_files();

}  // namespace plastron::app
