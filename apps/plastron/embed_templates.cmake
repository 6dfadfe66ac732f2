# Writes the files of the folder templates into a C++ file, as the table that templates.hpp declares.
file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/templates/*)
set(rows "")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND rows "    {\"${name}\", R\"template(${text})template\"},\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endforeach()
set(embedded_templates ${CMAKE_CURRENT_BINARY_DIR}/templates.cc)
file(CONFIGURE OUTPUT ${embedded_templates} CONTENT [[
#include "templates.hpp"

#include <array>

namespace plastron::app {

std::span<const EmbeddedFile> template_files() {
  static constexpr auto all = std::to_array<EmbeddedFile>({
@rows@  });
  return all;
}

}  // namespace plastron::app
]] @ONLY)
