#include <plastron/config/case.hpp>
#include <plastron/config/sections.hpp>

#include <fstream>
#include <iterator>

namespace plastron::config {

namespace {

constexpr std::uintmax_t largest_file = 1 << 20;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw CaseErrors({{.file = path.string(), .what = what}});
}

std::string contents(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(path, "there is no such file");
  if (std::filesystem::is_directory(status)) refuse(path, "this is a directory, not a case file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "the file cannot be read");
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size > largest_file) refuse(path, "the file is larger than 1 MB, which no case file is");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

Case read_case(const std::filesystem::path& path) { return parse_case(contents(path), path.string()); }

Case parse_case(std::string text, std::string file_name) {
  const Source source(std::move(text), std::move(file_name));
  Reading reading{.source = source};
  Table root(reading, section(""), parse_toml(source));
  Case result;
  result.title = root.text("title").value_or("");
  read_constants(root);
  read_shell(root, result.problem);
  const auto domain = read_geometry(root, result.problem);
  read_mesh(root, result.problem);
  read_supports(root, domain, result.problem);
  read_loads(root, domain, result.problem);
  read_obstacles(root, result.problem);
  read_probes(root, domain, result.problem);
  read_solver(root, result.problem);
  if (!reading.mistakes.empty()) throw CaseErrors(std::move(reading.mistakes));
  result.constants = std::move(reading.constants);
  result.effective = std::move(root.effective);
  return result;
}

}  // namespace plastron::config
