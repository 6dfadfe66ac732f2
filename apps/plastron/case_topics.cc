#include "layout.hpp"
#include "topic.hpp"

#include <plastron/config/schema.hpp>

#include <fmt/format.h>

namespace plastron::app {

namespace {

using config::Key;
using config::Section;

std::string path_of(const Section& section, const Key& key) {
  return section.path.empty() ? key.name : section.path + "." + key.name;
}

bool is_section(const std::string& path) {
  for (const Section& section : config::sections())
    if (section.path == path) return true;
  return false;
}

std::string written(const Key& key) {
  if (key.kind == config::Kind::tables) return fmt::format("{} = [{{ ... }}, ...], or [[...{}]]", key.name, key.name);
  const std::string value = !key.example.empty() ? key.example : key.fallback;
  return value.empty() ? "" : fmt::format("{} = {}", key.name, value);
}

std::string text_of(const Section& section, const Key& key) {
  constexpr std::size_t width = 9;
  std::string text = paragraph(key.meaning, 2) + "\n";
  const auto add = [&](const char* label, const std::string& what) {
    if (!what.empty()) text += row(label, width, what);
  };
  add("value", config::description(key.kind));
  add("unit", key.unit);
  add("allowed", key.words.empty() ? key.range.text(key.name) : config::joined(key.words));
  add("default", key.required ? "none, it is required" : key.fallback);
  add("written", written(key));
  add("section", section.path.empty() ? section.header : fmt::format("{} ({})", section.header, section.path));
  return text;
}

std::string line_of(const Key& key) {
  const std::string fallback = key.required ? "; required" : key.fallback.empty() ? "" : "; default " + key.fallback;
  return fmt::format("{}{}{}", key.meaning, key.unit.empty() ? "" : " [" + key.unit + "]", fallback);
}

std::string text_of(const Section& section) {
  std::string text = paragraph(section.meaning, 2);
  if (!section.keys.empty()) text += "\n";
  for (const Key& key : section.keys) text += row(key.name, 20, line_of(key));
  return text;
}

}  // namespace

std::vector<Topic> case_topics() {
  std::vector<Topic> topics;
  for (const Section& section : config::sections()) {
    if (!section.path.empty())
      topics.push_back({section.path, "section of the case file", {}, [&] { return text_of(section); }});
    for (const Key& key : section.keys)
      if (!is_section(path_of(section, key)))
        topics.push_back(
            {path_of(section, key), "key of the case file", key.words, [&] { return text_of(section, key); }});
  }
  return topics;
}

std::string case_overview() {
  std::string text = "Sections and keys of the case file (docs/case-file.md):\n";
  for (const Section& section : config::sections()) {
    std::string keys;
    for (const Key& key : section.keys) keys += (keys.empty() ? "" : ", ") + key.name;
    text += row(section.path.empty() ? "(the file)" : section.path, 26, keys.empty() ? section.meaning : keys);
  }
  return text;
}

}  // namespace plastron::app
