#include <fmt/format.h>
#include <plastron/config/overrides.hpp>
#include <plastron/config/printable.hpp>
#include <plastron/config/source.hpp>

#include <algorithm>
#include <cctype>
#include <optional>

namespace plastron::config {

namespace {

using Path = std::vector<std::string>;  // "[0]" for a place in a list

[[noreturn]] void refuse_setting(const std::string& option, std::string what, std::string advice = "") {
  throw CaseErrors({{.file = option, .what = std::move(what), .advice = std::move(advice)}});
}

bool is_bare(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }
bool is_index(const std::string& step) { return step.starts_with('['); }

/// Returns the end of the name, or of the place in a list, that begins at `at`.
std::size_t end_of_step(const std::string& key, std::size_t at) {
  if (key[at] == '[') return std::min(key.find(']', at), key.size() - 1) + 1;
  if (key[at] == '"' || key[at] == '\'') return std::min(key.find(key[at], at + 1), key.size() - 1) + 1;
  while (at < key.size() && is_bare(key[at])) ++at;
  return at;
}

bool is_step(const std::string& step) {
  if (step.empty()) return false;
  if (!is_index(step)) return is_bare(step[0]) || (step.size() > 2 && step.back() == step[0]);
  const std::string digits = step.substr(1, step.size() - 2);
  return step.back() == ']' && !digits.empty() && digits.size() < 6 &&
         std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Returns the parts of a key like obstacle[0].force; empty if it is no key.
Path path_of(const std::string& key) {
  Path path;
  for (std::size_t at = 0; at < key.size();) {
    if (!path.empty() && key[at] != '[' && key[at++] != '.') return {};
    const std::size_t end = at < key.size() ? end_of_step(key, at) : at;
    path.push_back(key.substr(at, end - at));
    if (!is_step(path.back()) || (path.size() == 1 && is_index(path[0]))) return {};
    at = end;
  }
  return path;
}

std::string unquoted(const std::string& name) {
  return name.starts_with('"') || name.starts_with('\'') ? name.substr(1, name.size() - 2) : name;
}

std::string dotted_key(std::span<const std::string> names) {
  std::string key;
  for (const std::string& name : names) key += (key.empty() ? "" : ".") + name;
  return key;
}

/// Checks the value's text, which must be valid TOML by itself.
void check_value(const std::string& value, const std::string& option) {
  if (value.find_first_not_of(" \t") == std::string::npos)
    refuse_setting(option, "the value is missing after =", "write --set key=value");
  try {
    const Source source("value = " + value, option);
    parse_toml(source);
  } catch (const CaseErrors& errors) {
    refuse_setting(
        option, errors.mistakes().front().what,
        "the value is written as in the case file, in quotes that the shell leaves: --set 'mesh.cells=\"triangle\"'");
  }
}

/// Returns the names in the header of a section that begins at `at`: "step.move" of [[step.move]].
std::string header_at(const std::string& text, std::size_t at) {
  std::string names;
  for (; at < text.size() && text[at] != '\n' && text[at] != '#'; ++at)
    if (is_bare(text[at]) || text[at] == '.') names += text[at];
  return names;
}

struct Target {
  const toml::value* value;  ///< the last existing value on the path
  std::size_t found = 0;     ///< number of steps that lead to it
};

Target find(const toml::value& root, const Path& path, const std::string& option) {
  Target target{&root};
  for (; target.found < path.size(); ++target.found) {
    const std::string& step = path[target.found];
    const auto so_far = dotted_key(std::span(path).first(target.found));
    if (is_index(step)) {
      const auto index = std::stoul(step.substr(1));
      if (!target.value->is_array()) refuse_setting(option, fmt::format("{} is no list in the case", so_far));
      const auto& list = target.value->as_array();
      if (index >= list.size())
        refuse_setting(option, fmt::format("{} has {} {}, counted from 0", so_far, list.size(),
                                           list.size() == 1 ? "entry" : "entries"));
      target.value = &list[index];
      continue;
    }
    if (target.value->is_array())
      refuse_setting(option, fmt::format("{} has several entries", so_far),
                     fmt::format("say which one: {}[0] is the first", so_far));
    if (!target.value->is_table()) refuse_setting(option, fmt::format("{} has no keys in the case", so_far));
    const auto entry = target.value->as_table().find(unquoted(step));
    if (entry == target.value->as_table().end()) break;
    target.value = &entry->second;
  }
  return target;
}

/// Whether a value is on several lines of its own, under a header or by keys with dots.
bool is_spread(const Source& source, const toml::value& value) {
  const auto begins = [&](const toml::value& v) { return source.text()[source.value(v).offset]; };
  if (value.is_table()) return begins(value) != '{';
  return value.is_array() && !value.as_array().empty() && value.as_array()[0].is_table() &&
         begins(value.as_array()[0]) != '{';
}

struct Insertion {
  std::size_t offset;
  std::string text;
};

/// Returns a line under a header, or a further entry in braces; nothing where neither exists.
std::optional<Insertion> into(const Source& source, const toml::value& table, const std::string& names,
                              const std::string& line) {
  const std::string& text = source.text();
  const std::size_t at = source.value(table).offset;
  if (text[at] == '{') {
    const std::size_t next = text.find_first_not_of(" \t", at + 1);
    return Insertion{at + 1, " " + line + (next < text.size() && text[next] == '}' ? " " : ",")};
  }
  if (text[at] != '[' || header_at(text, at) != names) return {};
  std::size_t end = std::min(text.find('\n', at), text.size());
  if (end > at && text[end - 1] == '\r') --end;
  return Insertion{end, "\n" + line};
}

/// Returns the place and the text of a key that is not in the file.
Insertion insertion(const Source& source, const toml::value& root, const Target& target, const Path& path,
                    const std::string& value, const std::string& option) {
  Path names;
  std::ranges::copy_if(std::span(path).first(target.found), std::back_inserter(names),
                       [](const std::string& step) { return !is_index(step); });
  const std::span rest = std::span(path).subspan(target.found);
  if (std::ranges::any_of(rest, is_index))
    refuse_setting(option, fmt::format("the case has no {}", dotted_key(names) + (names.empty() ? "" : ".") + rest[0]));
  const std::string line = dotted_key(rest) + " = " + value;
  if (target.value == &root && rest.size() == 1) return {0, line + "\n"};
  if (target.value != &root)
    if (auto found = into(source, *target.value, dotted_key(names), line)) return *found;
  if (target.found != names.size())
    refuse_setting(option, fmt::format("{} cannot be added to where its keys have dots", dotted_key(names)),
                   "give it a section or braces in the case file");
  Path section = names;
  section.insert(section.end(), rest.begin(), rest.end() - 1);
  return {source.text().size(), fmt::format("\n[{}]\n{} = {}\n", dotted_key(section), rest.back(), value)};
}

int lines_in(std::string_view text) { return static_cast<int>(std::ranges::count(text, '\n')); }

std::size_t offset_of(const std::string& text, int line, int column) {
  std::size_t at = 0;
  for (; line > 1 && at < text.size(); ++at)
    if (text[at] == '\n') --line;
  for (; column > 1 && at < text.size(); --column) at += std::max<std::size_t>(code_point_length(text, at), 1);
  return at;
}

}  // namespace

Overrides::Overrides(std::string text, std::string file_name, std::span<const std::string> settings)
    : text_(std::move(text)), file_name_(std::move(file_name)) {
  if (settings.empty()) return;
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  for (const std::string& setting : settings) apply(setting);
  std::string comments;
  for (const std::string& setting : settings) comments += "# --set " + setting + "\n";
  replace(0, 0, comments, "");
}

void Overrides::replace(std::size_t offset, std::size_t length, const std::string& by, const std::string& option) {
  const int lost = lines_in(std::string_view(text_).substr(offset, length));
  for (Edit& edit : edits_) {
    if (edit.offset >= offset + length)
      edit.offset += by.size() - length;
    else if (edit.offset + edit.length >= offset + length)
      edit.length += by.size() - length;
  }
  text_.replace(offset, length, by);
  edits_.push_back({offset, by.size(), lost, option});
}

void Overrides::apply(const std::string& setting) {
  const std::string option = "--set " + setting;
  const std::size_t equals = setting.find('=');
  if (has_control_characters(setting)) refuse_setting(option, "a setting has a control character");
  if (equals == std::string::npos) refuse_setting(option, "a setting has no =", "write --set key=value");
  const std::string key = setting.substr(0, equals), value = setting.substr(equals + 1);
  const Path path = path_of(key.substr(0, key.find_last_not_of(" \t") + 1));
  if (path.empty())
    refuse_setting(option, fmt::format("\"{}\" is no key of a case file", key),
                   "write it like shell.thickness, mesh.refinements or obstacle[0].force");
  check_value(value, option);
  const Source source(text_, file_name_);
  const toml::value root = parse_toml(source);
  const Target target = find(root, path, option);
  if (target.found < path.size()) {
    const Insertion put = insertion(source, root, target, path, value, option);
    replace(put.offset, 0, put.text, option);
    return;
  }
  if (is_spread(source, *target.value))
    refuse_setting(option, fmt::format("{} is a section of the case", key), "set its keys one by one");
  const Place place = source.value(*target.value);
  replace(place.offset, place.length, value, option);
}

std::vector<Mistake> Overrides::of_user(std::vector<Mistake> mistakes) const {
  for (Mistake& mistake : mistakes) {
    if (mistake.line == 0) continue;
    const std::size_t at = offset_of(text_, mistake.line, mistake.column);
    const Edit* last = nullptr;
    int line = mistake.line;
    for (const Edit& edit : edits_) {
      if (edit.offset <= at && at < edit.offset + edit.length) last = &edit;
      if (edit.offset + edit.length <= at)
        line += edit.lost_lines - lines_in(std::string_view(text_).substr(edit.offset, edit.length));
    }
    mistake.line = line;
    if (last == nullptr) continue;
    mistake.file = last->option;
    mistake.line = 0;
  }
  return mistakes;
}

}  // namespace plastron::config
