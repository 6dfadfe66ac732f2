// plastron._case: reading of cases, and the declarations of the case file and of results.json. It loads no solver, so that
// `import plastron` takes little time.
#include "exceptions.hpp"
#include "functions.hpp"

#include <plastron/config/case.hpp>
#include <plastron/config/schema.hpp>
#include <plastron/io/finished_results.hpp>
#include <plastron/io/flat_row.hpp>
#include <plastron/io/results.hpp>

#include <nlohmann/json.hpp>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plastron::python {

namespace {

/// Returns (effective settings as JSON, text with settings, files that the case names as (name, path)).
py::tuple read(const std::string& text, const std::string& file_name, const std::vector<std::string>& settings) {
  try {
    const config::Case c = raising_interruptions([&] { return config::parse_case(text, file_name, settings); });
    py::list files;
    for (const auto& [name, path] : c.files) files.append(py::make_tuple(name, path.string()));
    return py::make_tuple(c.effective.dump(), c.text, files);
  } catch (const config::CaseErrors& errors) {
    throw_case_error(errors);
  } catch (const geometry::FunctionError& error) {
    raise("CaseError", file_name + ": error: " + error.what() + "\n");
  }
}

/// Raises CaseError if the file is not a case.
void check_file(const std::string& path, const std::vector<std::string>& settings) {
  try {
    config::read_case(path, settings);
  } catch (const config::CaseErrors& errors) {
    throw_case_error(errors);
  }
}

/// Returns a list of (path, meaning, keys), where a key is (name, kind, unit, default, allowed values, meaning, whether it
/// is required).
py::list declarations() {
  py::list all;
  for (const config::Section& section : config::sections()) {
    py::list keys;
    for (const config::Key& key : section.keys)
      keys.append(py::make_tuple(key.name, config::description(key.kind), key.unit, key.fallback,
                                 config::allowed_values(key), key.meaning, key.required));
    all.append(py::make_tuple(section.path, section.meaning, keys));
  }
  return all;
}

}  // namespace

}  // namespace plastron::python

PYBIND11_MODULE(_case, module) {
  using namespace plastron;
  namespace py = pybind11;
  module.doc() = "Cases and declarations, without the solver.";
  module.def("read", &python::read, py::arg("text"), py::arg("file_name"), py::arg("settings"));
  module.def("give_function", &python::give_function);
  module.def("forget_function", &geometry::forget_function);
  module.def("check_file", &python::check_file, py::arg("path"), py::arg("settings"));
  module.def("declarations", &python::declarations);
  module.def("result_row", [](const std::string& results) { return io::result_row(io::Json::parse(results)); });
  module.def("finished_results",
             [](const std::string& folder, const std::string& text,
                const std::vector<std::pair<std::string, std::filesystem::path>>& files) -> std::optional<std::string> {
               const io::Json results = io::finished_results(folder, text, files);
               if (results.is_null()) return {};
               return results.dump();
             });
  module.def("csv_cell", &io::csv_cell);
  module.attr("version") = std::string(io::version);
}
