#include <plastron/config/case.hpp>
#include <plastron/config/overrides.hpp>
#include <plastron/config/sections.hpp>

#include <fstream>
#include <string>

namespace plastron::config {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw CaseErrors({{.file = path.string(), .what = what}});
}

/// Returns the kind of a file system entry that is not a regular file.
std::string kind_of(std::filesystem::file_type type) {
  using enum std::filesystem::file_type;
  if (type == directory) return "a directory";
  if (type == fifo) return "a pipe";
  if (type == character || type == block) return "a device";
  return type == socket ? "a socket" : "no file with contents";
}

/// Reads at most one byte beyond the limit, for any reported file size.
std::string contents(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(path, "there is no such file");
  if (!std::filesystem::is_regular_file(status))
    refuse(path, fmt::format("this is {}, not a case file", kind_of(status.type())));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "the file cannot be read");
  std::string text(largest_file + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) refuse(path, "the file cannot be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest_file)
    refuse(path, fmt::format("the file is larger than {} kB, which no case file is", largest_file / 1024));
  return text;
}

Case parsed(std::string text, std::string file_name, std::filesystem::path folder) {
  Case result;
  result.text = text;
  const Source source(std::move(text), std::move(file_name));
  Reading reading{.source = source, .folder = std::move(folder)};
  Table root(reading, section(""), parse_toml(source));
  result.title = root.text("title").value_or("");
  read_constants(root);
  read_materials(root);
  read_geometry(root, result.problem);  // the variables of other fields depend on it
  read_imperfections(root, result.problem);
  read_shell(root, result.problem);
  read_regions(root, result.problem);
  read_named_edges(root);
  read_mesh(root, result.problem);
  read_joins(root, result.problem);
  read_rigid_bodies(root, result.problem);
  read_supports(root, result.problem);
  complete_geometry(result.problem);
  read_temperatures(root, result.problem);
  read_foundations(root, result.problem);
  read_loads(root, result.problem);
  read_gravity(root, result.problem);
  read_obstacles(root, result.problem);
  read_steps(root, result.problem);
  read_probes(root, result.problem);
  read_lines(root, result.problem);
  read_accuracy(root, result.problem);
  read_contact(root, result.problem);
  read_model(root, result.problem);
  read_modes(root, result.problem);
  read_solver(root, result.problem);
  const nlohmann::json effective = root.effective;  // the checks read tables once more
  check_rotations(root, result.problem);
  check_control(root, result.problem);
  root.effective = effective;
  read_units(root, result.problem);
  complete_part(root, result.problem);
  result.wants_report = read_output(root, result.problem);
  if (reading.more_mistakes)
    reading.mistakes.push_back(
        {.file = source.file_name(), .what = fmt::format("more than {} mistakes; these are the first", most_mistakes)});
  if (!reading.mistakes.empty()) throw CaseErrors(std::move(reading.mistakes));
  result.constants = std::move(reading.constants);
  result.effective = std::move(root.effective);
  result.files = std::move(reading.files);
  return result;
}

}  // namespace

Case parse_case(std::string text, std::string file_name, std::span<const std::string> settings) {
  const std::filesystem::path folder = std::filesystem::path(file_name).parent_path();
  if (settings.empty()) return parsed(std::move(text), std::move(file_name), folder);
  const Overrides overrides(std::move(text), file_name, settings);
  try {
    return parsed(overrides.text(), std::move(file_name), folder);
  } catch (const CaseErrors& errors) {
    throw CaseErrors(overrides.of_user(errors.mistakes()));
  }
}

Case read_case(const std::filesystem::path& path, std::span<const std::string> settings) {
  return parse_case(contents(path), path.string(), settings);
}

Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return parsed(contents(path), path.string(), folder);
}

}  // namespace plastron::config
