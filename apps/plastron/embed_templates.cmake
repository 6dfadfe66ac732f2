# Writes the templates and the cases of the gallery into a C++ file, as the table that templates.hpp declares: each case, and after it the
# files beside it that it names.
file(GLOB templates CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/templates/*.toml)
file(GLOB gallery CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cases/*/case.toml)
set(rows "")
foreach(collection templates gallery)
  foreach(case IN LISTS ${collection})
    string(REGEX REPLACE "(/case)?\\.toml$" "" example ${case})
    get_filename_component(example ${example} NAME)
    get_filename_component(folder ${case} DIRECTORY)
    file(READ ${case} text)
    string(REGEX MATCHALL "\"[A-Za-z0-9_-]+\\.[a-z]+\"" quoted "${text}")
    list(REMOVE_DUPLICATES quoted)
    set(files "")
    foreach(name IN LISTS quoted)
      string(REPLACE "\"" "" name ${name})
      if(EXISTS ${folder}/${name})
        list(APPEND files ${name})
      endif()
    endforeach()
    string(APPEND rows "    {\"${collection}\", \"${example}\", \"case.toml\", R\"template(${text})template\"sv},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${case})
    foreach(name IN LISTS files)
      file(READ ${folder}/${name} text)
      string(APPEND rows "    {\"${collection}\", \"${example}\", \"${name}\", R\"template(${text})template\"sv},\n")
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${name})
    endforeach()
  endforeach()
endforeach()
set(embedded_templates ${CMAKE_CURRENT_BINARY_DIR}/templates.cc)
file(CONFIGURE OUTPUT ${embedded_templates} CONTENT [[
#include "templates.hpp"

#include <array>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Woverlength-strings"  // clang's, for meshes of more than 65536 characters

namespace plastron::app {

std::span<const EmbeddedFile> example_files() {
  using std::string_view_literals::operator""sv;
  static constexpr auto all = std::to_array<EmbeddedFile>({
@rows@  });
  return all;
}

}  // namespace plastron::app

#pragma GCC diagnostic pop
]] @ONLY)
