#include "exit_codes.hpp"
#include "layout.hpp"
#include "topic.hpp"

#include <plastron/contact/statuses.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/results_schema.hpp>

#include <fmt/format.h>

namespace plastron::app {

namespace {

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

}  // namespace

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

}  // namespace plastron::app
