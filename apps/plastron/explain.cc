// plastron explain: the manual for one word. Its topics are keys of the case file, fields and numbers of the results,
// statuses, and limits of the program. Each is made from the declaration that the program itself uses.
#include "command_line.hpp"
#include "terminal.hpp"

#include <plastron/config/limits.hpp>
#include <plastron/config/nearest.hpp>
#include <plastron/config/schema.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/results_schema.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace plastron::app {

namespace {

struct Topic {
  std::string name;                    ///< "shell.thickness"
  std::string what;                    ///< "key of the case file"
  std::vector<std::string> aliases{};  ///< other words for it
  std::function<std::string()> text{};
  /// Whether the word names the topic: is_called() by the whole name or an alias, ends_with() without the first parts.
  bool is_called(const std::string& word) const {
    return name == word || std::ranges::find(aliases, word) != aliases.end();
  }
  bool ends_with(const std::string& word) const { return name.ends_with("." + word); }
};

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
  add("allowed", config::allowed_values(key));
  add("default", key.required ? "none; required" : key.fallback);
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

/// Returns sections of the case file and their keys.
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

/// Returns the topics of the case file, one line for each section.
std::string case_overview() {
  std::string text = "Sections and keys of the case file (docs/case-file.md):\n";
  for (const Section& section : config::sections()) {
    std::string keys;
    for (const Key& key : section.keys) keys += (keys.empty() ? "" : ", ") + key.name;
    text += row(section.path.empty() ? "(the file)" : section.path, 26, keys.empty() ? section.meaning : keys);
  }
  return text;
}

using io::Entry;
using io::Part;

/// Returns "a.b.NAME" without "[]", in the form that people write.
std::string plain(std::string name) {
  for (std::size_t at = 0; (at = name.find("[]")) != std::string::npos;) name.erase(at, 2);
  return name;
}

std::string form_text(io::Form form) {
  switch (form) {
    case io::Form::number:
      return "a number, null where it is not finite";
    case io::Form::integer:
      return "a whole number";
    case io::Form::text:
      return "text";
    case io::Form::flag:
      return "true or false";
    case io::Form::pair:
      return "a list of two numbers";
    case io::Form::triple:
      return "a list of three numbers";
  }
  return "";
}

std::string text_of(const Part& part, const Entry& entry) {
  std::string text = paragraph(entry.meaning, 2) + "\n";
  text += row("value", 9, form_text(entry.form) + (entry.can_be_absent ? "; null where it has no meaning" : ""));
  if (entry.unit != "-") text += row("unit", 9, entry.unit);
  return text + row("part", 9, part.meaning);
}

std::string part_name(const Part& part) {
  std::string name = io::dotted(part.place, "");
  if (name.ends_with('.')) name.pop_back();
  return name;
}

std::string text_of(const Part& part) {
  std::string text = paragraph(part.meaning, 2) + "\n";
  for (const Entry& e : part.entries)
    text += row(io::dotted("", e.path), 30,
                fmt::format("{}{}", e.meaning, e.unit == "-" ? "" : fmt::format(" [{}]", e.unit)));
  return text;
}

std::string text_of(const io::Field& field) {
  std::string arrays;
  for (const std::string& array : field.arrays) arrays += fmt::format("{}{}", arrays.empty() ? "" : ", ", array);
  std::string text = paragraph(field.meaning, 2) + "\n";
  text += row("symbol", 9, field.symbol) + row("unit", 9, field.unit);
  text += row("array", 9, fmt::format("{}{} in solution.vtu", arrays, field.is_vector() ? " (vector)" : ""));
  text += row("probe", 9, io::dotted("probes/*/", field.key) + " in results.json");
  if (field.presence == io::Presence::with_obstacle) text += row("where", 9, "with an obstacle");
  if (field.presence == io::Presence::with_multiplier) text += row("where", 9, "in the mixed formulation");
  return text;
}

std::string text_of(contact::Status status) {
  return paragraph(contact::explain(status), 2) + "\n" + row("exit code", 9, std::to_string(exit_code(status)));
}

void add_fields(std::vector<Topic>& topics) {
  for (const io::Field& field : io::fields()) {
    std::vector<std::string> aliases(field.arrays.begin(), field.arrays.end());
    aliases.emplace_back(field.symbol);
    topics.push_back(
        {io::dotted("", field.key), "field of the results", std::move(aliases), [&field] { return text_of(field); }});
  }
}

void add_parts(std::vector<Topic>& topics) {
  for (const Part& part : io::parts()) {
    const std::string name = part_name(part);
    if (!name.empty())
      topics.push_back({name, "part of results.json", {plain(name)}, [&part] { return text_of(part); }});
    if (part.place.ends_with("probes/*/")) continue;  // these are the fields
    for (const Entry& entry : part.entries) {
      const std::string path = io::dotted(part.place, entry.path);
      topics.push_back({path, "number of results.json", {plain(path)}, [&] { return text_of(part, entry); }});
      if (entry.form == io::Form::text) topics.back().what = "text in results.json";
    }
  }
}

/// Returns statuses, fields, and the contents of results.json.
std::vector<Topic> result_topics() {
  std::vector<Topic> topics;
  for (const contact::Status status : contact::statuses())
    topics.push_back({std::string(contact::to_string(status)), "status", {}, [status] { return text_of(status); }});
  add_fields(topics);
  add_parts(topics);
  return topics;
}

std::string result_overview() {
  std::string text = "Fields of the results (solution.vtu, and probes in results.json):\n";
  for (const io::Field& field : io::fields()) text += row(io::dotted("", field.key), 26, field.meaning);
  text += "\nParts of results.json (docs/results.md):\n";
  for (const Part& part : io::parts()) {
    const std::string name = part_name(part);
    text += row(name.empty() ? "(the top)" : name, 26, part.meaning);
  }
  text += "\nStatuses:\n";
  std::string statuses;
  for (const contact::Status status : contact::statuses())
    statuses += fmt::format("{}{}", statuses.empty() ? "" : ", ", contact::to_string(status));
  return text + paragraph(statuses, 2);
}

using config::Limit;

std::string text_of(const Limit& limit) {
  constexpr std::size_t width = 9;
  return paragraph(limit.left_out, 2) + "\n" + row("result", width, limit.shows) + row("remedy", width, limit.advice) +
         row("page", width, "docs/limits.md");
}

std::vector<Topic> limit_topics() {
  std::vector<Topic> topics;
  for (const Limit& limit : config::limits()) {
    std::vector<std::string> words;
    std::ranges::copy_if(limit.aliases, std::back_inserter(words),
                         [](const std::string& alias) { return !alias.starts_with('.'); });  // a section only
    topics.push_back({limit.name, "limit of the program", std::move(words), [&limit] { return text_of(limit); }});
  }
  return topics;
}

std::string limit_overview() {
  std::string names;
  for (const Limit& limit : config::limits()) names += (names.empty() ? "" : ", ") + limit.name;
  return "Limits of the program (docs/limits.md):\n" + paragraph(names, 2);
}

std::vector<Topic> all_topics() {
  std::vector<Topic> all = case_topics();
  for (std::vector<Topic> more : {result_topics(), limit_topics()}) std::ranges::move(more, std::back_inserter(all));
  return all;
}

/// Returns "obstacle.ball" for "[[obstacle]].ball", "obstacle[0].ball" and "obstacle[].ball"; "shell" for "[shell]".
std::string plain_word(const std::string& word) {
  std::string result;
  std::string_view rest = word;
  while (rest.starts_with('[')) rest.remove_prefix(1);
  bool in_index = false;
  for (const char c : rest) {
    in_index = (in_index || c == '[') && c != ']';
    if (!in_index && c != ']') result += c;
  }
  return result;
}

/// Returns "elastic-foundation" for "Elastic foundation" and "elastic_foundation", as limits are named.
std::string hyphenated(std::string word) {
  std::ranges::transform(word, word.begin(), [](unsigned char c) {
    return c == ' ' || c == '_' ? '-' : static_cast<char>(std::tolower(c));
  });
  return word;
}

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

ExitCode refuse(const std::string& word, const std::vector<Topic>& topics) {
  std::vector<std::string> known;
  for (const Topic& topic : topics) {
    known.push_back(topic.name);
    known.push_back(last_part(topic.name));
    known.insert(known.end(), topic.aliases.begin(), topic.aliases.end());
  }
  std::ranges::sort(known);
  known.erase(std::unique(known.begin(), known.end()), known.end());
  constexpr std::size_t most = 5;
  const auto near = config::nearest_few(word, known, most);
  const std::string advice = near.empty() ? "" : fmt::format("did you mean {}? ", fmt::join(near, ", "));
  print_error("error: unknown word \"{}\"; {}plastron explain lists all words\n", word, advice);
  return bad_input;
}

void print_topic(const Topic& topic, bool is_first) {
  if (is_first_rank()) print_text(stdout, fmt::format("{}{}: {}\n", is_first ? "" : "\n", topic.name, topic.what));
  if (is_first_rank()) print_text(stdout, topic.text());
}

}  // namespace

std::vector<std::string> explained_words() {
  std::vector<std::string> words;
  for (const Topic& topic : all_topics()) words.push_back(plain_word(topic.name));
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

ExitCode explain(const std::string& given) {
  if (given.empty()) {
    if (is_first_rank())
      print_text(stdout, case_overview() + "\n" + result_overview() + "\n" + limit_overview() +
                             "\nplastron explain WORD explains each of them.\n");
    return solved;
  }
  const std::vector<Topic> topics = all_topics();
  bool is_first = true;
  for (const std::string& word : {plain_word(given), hyphenated(plain_word(given))}) {
    for (const bool in_full : {true, false})
      for (const Topic& topic : topics)
        if (in_full ? topic.is_called(word) : !topic.is_called(word) && topic.ends_with(word)) {
          print_topic(topic, is_first);
          is_first = false;
        }
    if (!is_first) return solved;
  }
  return refuse(given, topics);
}

}  // namespace plastron::app
