#include <plastron/config/limits.hpp>
#include <plastron/config/nearest.hpp>
#include <plastron/config/table.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>
#include <sstream>

namespace plastron::config {

namespace {

toml::value parsed(const std::string& toml_text) {
  std::istringstream stream("value = " + toml_text);
  return toml::parse(stream, "default").at("value");
}

template <class Value>
nlohmann::json json_of(const Value& value) {
  return value;
}
nlohmann::json json_of(const geometry::Expression& field) { return as_json(field); }
template <class Value>
nlohmann::json json_of(const std::vector<Value>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& value : values) list.push_back(json_of(value));
  return list;
}

std::vector<std::string> names(const std::vector<Key>& keys) {
  std::vector<std::string> all;
  std::ranges::transform(keys, std::back_inserter(all), &Key::name);
  return all;
}

// Returns the headers of the other sections that have a key of this name.
std::string belongs(const std::string& name) {
  std::string headers;
  for (const Section& other : sections()) {
    if (other.path.empty() || std::ranges::count(other.keys, name, &Key::name) == 0) continue;
    headers += (headers.empty() ? "" : " or ") + other.header;
  }
  return headers.empty() ? "" : fmt::format("\"{}\" belongs in {}", name, headers);
}

auto list_reader(Kind kind, std::size_t count, auto read) {
  return [=](Reading& reading, const Item& item) { return read_list(reading, item, kind, count, read); };
}

}  // namespace

nlohmann::json as_json(const geometry::Expression& field) {
  if (field.is_constant()) return field(0, 0);
  return field.text();
}

Table::Table(Reading& reading, const Section& section, toml::value value)
    : reading_(&reading), section_(&section), value_(std::move(value)) {
  if (!section.other_keys.empty()) return;
  for (const auto& [name, entry] : entries(reading, value_))
    if (std::ranges::count(section.keys, name, &Key::name) == 0) report_unknown(name, entry);
}

std::vector<std::pair<std::string, toml::value>> Table::other_entries() const {
  auto all = entries(*reading_, value_);
  std::erase_if(all,
                [&](const auto& entry) { return std::ranges::count(section_->keys, entry.first, &Key::name) > 0; });
  return all;
}

const Key& Table::declared(const std::string& name) const {
  const auto key = std::ranges::find(section_->keys, name, &Key::name);
  if (key == section_->keys.end()) throw std::logic_error(section_->path + " declares no " + name);
  return *key;
}

void Table::report_unknown(const std::string& name, const toml::value& value) const {
  const auto known = names(section_->keys);
  const bool is_section = section_->path.empty() && (value.is_table() || value.is_array());
  std::string advice = did_you_mean(name, known);
  if (const Limit* limit = limit_of(section_->path, name))
    advice = fmt::format("{} Instead: {} (docs/limits.md, {})", limit->left_out, limit->advice, limit->name);
  else if (advice.empty())
    advice = belongs(name);
  reading_->report(reading_->source.key(name, value),
                   is_section ? fmt::format("unknown section [{}]", geometry::shortened(name))
                              : fmt::format("unknown key \"{}\" in {}", geometry::shortened(name), section_->header),
                   joined(known), advice);
}

bool Table::is_mistyped(const Key& key) const {
  const auto known = names(section_->keys);
  const auto means_it = [&](const auto& entry) {
    return nearest(entry.first, known) == key.name && !limit_of(section_->path, entry.first);
  };
  return section_->other_keys.empty() && std::ranges::any_of(other_entries(), means_it);
}

void Table::report_missing(const Key& key) const {
  if (is_mistyped(key)) return;  // told with the unknown key
  if (section_->path.empty())
    reading_->mistakes.push_back(
        {.file = reading_->source.file_name(), .what = fmt::format("the section [{}] is missing", key.name)});
  else
    report_here(fmt::format("{} has no \"{}\"", section_->header, key.name), key.range.text(key.name),
                fmt::format("add {} = {}", key.name, key.example));
}

void Table::report(const std::string& name, std::string what, std::string allowed, std::string advice) const {
  reading_->report(value_.as_table().at(name), std::move(what), std::move(allowed), std::move(advice));
}

void Table::report_key(const std::string& name, std::string what, std::string allowed, std::string advice) const {
  reading_->report(reading_->source.key(name, value_.as_table().at(name)), std::move(what), std::move(allowed),
                   std::move(advice));
}

void Table::report_here(std::string what, std::string allowed, std::string advice) const {
  reading_->report(value_, std::move(what), std::move(allowed), std::move(advice));
}

std::optional<toml::value> Table::value(const std::string& name) const {
  if (has(name)) return value_.as_table().at(name);
  const Key& key = declared(name);
  if (key.required) report_missing(key);
  if (key.fallback.empty()) return {};
  return parsed(key.fallback);
}

template <class Read>
auto Table::read(const std::string& name, Read read_value) {
  using Result = std::invoke_result_t<Read, Reading&, const Item&>;
  const auto given = value(name);
  if (!given) return Result{};
  Result result = read_value(*reading_, Item{*given, name, declared(name).range, declared(name).unit});
  if (result) effective[name] = json_of(*result);
  return result;
}

std::optional<bool> Table::boolean(const std::string& name) { return read(name, read_boolean); }
std::optional<int> Table::integer(const std::string& name) { return read(name, read_integer); }
std::optional<double> Table::number(const std::string& name) { return read(name, read_number); }
std::optional<geometry::Expression> Table::field(const std::string& name) { return read(name, read_field); }

std::optional<std::vector<double>> Table::numbers(const std::string& name) {
  return read(name, list_reader(Kind::numbers, 0, read_number));
}

std::optional<Eigen::Vector2d> Table::point(const std::string& name) { return read(name, read_vector<2>); }
std::optional<Eigen::Vector3d> Table::vector(const std::string& name) { return read(name, read_vector<3>); }

std::optional<ShellPlace> Table::place(const std::string& name) { return read(name, read_place); }
std::optional<std::vector<ShellPlace>> Table::places(const std::string& name) {
  return read(name, list_reader(Kind::places, 0, read_place));
}

std::optional<std::vector<Eigen::Vector3d>> Table::vectors(const std::string& name) {
  return read(name, list_reader(Kind::vectors, 0, read_vector<3>));
}

std::optional<Eigen::Vector3d> Table::direction(const std::string& name) {
  const auto given = vector(name);
  if (!given) return {};
  if (const double length = given->stableNorm(); length > 0) return *given / length;
  report(name, fmt::format("the {} is the zero vector", name), "",
         name == "normal" ? "give the direction of the free side, for example [0, 0, 1]"
                          : "give a direction, for example [0, 0, 1]");
  return {};
}

std::optional<std::array<int, 2>> Table::cell_counts(const std::string& name) {
  const auto list = read(name, list_reader(Kind::cell_counts, 2, read_integer));
  if (!list) return {};
  return std::array{(*list)[0], (*list)[1]};
}

std::optional<energy::VectorExpression> Table::field_vector(const std::string& name) {
  const auto list = read(name, list_reader(Kind::field_vector, 3, read_field));
  if (!list) return {};
  return energy::VectorExpression{(*list)[0], (*list)[1], (*list)[2]};
}

bool Table::check_word(const Key& key, const Item& item, const std::string& word) const {
  if (key.words.empty() || std::ranges::find(key.words, word) != key.words.end()) return true;
  reading_->report(item.value, fmt::format("unknown word \"{}\" for {}", geometry::shortened(word), item.name),
                   allowed_values(key), did_you_mean(word, key.words));
  return false;
}

std::optional<std::string> Table::text(const std::string& name) {
  const Key& key = declared(name);
  auto word = read(name, [&](Reading& reading, const Item& item) -> std::optional<std::string> {
    const bool may_be_false = key.kind == Kind::word_or_false;
    if (may_be_false && item.value.is_boolean() && !item.value.as_boolean()) return "";
    auto given = key.kind == Kind::name ? read_name(reading, item)
                                        : read_text(reading, item, may_be_false ? key.kind : Kind::text);
    return given && check_word(key, item, *given) ? given : std::nullopt;
  });
  if (word && word->empty() && key.kind == Kind::word_or_false) effective[name] = false;
  return word;
}

std::optional<std::vector<std::string>> Table::texts(const std::string& name) {
  const auto read_one = [this, &key = declared(name)](Reading& reading, const Item& item) {
    auto word = key.words.empty() ? read_name(reading, item) : read_text(reading, item);
    return word && check_word(key, item, *word) ? word : std::nullopt;
  };
  return read(name, list_reader(Kind::names, 0, read_one));
}

std::optional<std::string> Table::checked_name(const Item& item, const std::string& what,
                                               const std::vector<std::string>& known) const {
  auto name = read_name(*reading_, item);
  if (!name) return {};
  if (name->empty())
    reading_->report(item.value, fmt::format("the {} has no name", what));
  else if (!known.empty() && std::ranges::count(known, *name) == 0)
    report_unknown_name(item, what, *name, known);
  else
    return name;
  return {};
}

std::optional<std::string> Table::known_name(const std::string& name, const std::string& what,
                                             const std::vector<std::string>& known) {
  return read(name, [&](Reading& /*reading*/, const Item& item) { return checked_name(item, what, known); });
}

std::optional<std::vector<std::string>> Table::name_list(const std::string& name, const std::string& what,
                                                         const std::vector<std::string>& known) {
  const auto given = value(name);
  if (!given) return {};
  if (given->is_string()) {
    const auto one = known_name(name, what, known);
    return one ? std::optional(std::vector{*one}) : std::nullopt;
  }
  std::vector<std::string> seen;
  const auto read_one = [&](Reading& reading, const Item& item) {
    auto word = checked_name(item, what, known);
    if (word && std::ranges::count(seen, *word) > 0) {
      reading.report(item.value, fmt::format("the {} \"{}\" is named twice", what, *word));
      word.reset();
    }
    if (word) seen.push_back(*word);
    return word;
  };
  if (given->is_array() && given->as_array().empty()) {
    report(name, fmt::format("{} names no {}", name, what), joined(known));
    return {};
  }
  return read(name, list_reader(Kind::name_or_names, 0, read_one));
}

void Table::report_unknown_name(const Item& item, const std::string& what, const std::string& name,
                                const std::vector<std::string>& known) const {
  const bool unnamed = known == std::vector<std::string>{""};
  reading_->report(
      item.value, fmt::format("the domain has no {} \"{}\"", what, geometry::shortened(name)),
      unnamed ? "" : joined(known),
      unnamed ? fmt::format("the domain is one {0} without a name: give a rectangle breaks and {0}s, or take a "
                            "mesh file with named surfaces",
                            what)
              : did_you_mean(name, known));
}

std::optional<std::optional<double>> Table::angle_or_none(const std::string& name) {
  const auto degrees = number(name);
  return degrees ? std::optional(*degrees * std::numbers::pi / 180) : std::nullopt;
}

std::optional<std::string> Table::shape(const std::string& example, const std::string& advice_for_several) const {
  const auto& shapes = section_->exactly_one;
  std::vector<std::string> given;
  std::ranges::copy_if(shapes, std::back_inserter(given), [&](const std::string& name) { return has(name); });
  if (given.size() == 1) return given[0];
  const std::string& header = section_->header;
  if (given.empty())
    report_here(fmt::format("{} names no shape", header), joined(shapes), "for example " + example);
  else
    report_key(given[1], fmt::format("{} has both {} and {}", header, given[0], given[1]),
               fmt::format("one of {}", joined(shapes)), advice_for_several);
  return {};
}

const Section& Table::section_of(const std::string& name) const {
  return section(section_->path.empty() ? name : section_->path + "." + name);
}

bool Table::in_table(const std::string& name, const std::function<void(Table&)>& read_table) {
  const auto given = value(name);
  if (!given) return false;
  if (!given->is_table()) {
    report_kind(*reading_, Item{*given, name}, Kind::table);
    return false;
  }
  Table table(*reading_, section_of(name), *given);
  read_table(table);
  effective[name] = std::move(table.effective);
  return true;
}

void Table::in_tables(const std::string& name, const std::function<void(Table&)>& read_table) {
  effective[name] = nlohmann::json::array();
  for (Table& table : tables(name)) {
    read_table(table);
    effective[name].push_back(std::move(table.effective));
  }
}

std::vector<Table> Table::tables(const std::string& name) const {
  std::vector<Table> all;
  const toml::value given = value(name).value();
  if (given.is_table()) {
    report_key(name, fmt::format("[{}] is a repeated section", name), "",
               fmt::format("write [[{}]] with double brackets", name));
  } else if (!given.is_array()) {
    report_kind(*reading_, Item{given, name}, Kind::tables);
  } else {
    for (const toml::value& entry : given.as_array()) {
      if (entry.is_table())
        all.emplace_back(*reading_, section_of(name), entry);
      else
        report_kind(*reading_, Item{entry, "an entry of " + name}, Kind::table);
    }
  }
  return all;
}

bool Table::fill_keys(const std::any& object) {
  bool all = true;
  for (const Key& key : section_->keys)
    if (key.put && !key.put(*this, key, object)) all = false;
  return all;
}

Key key(std::string name, Kind kind, Key rest, std::string meaning) {
  rest.name = std::move(name);
  rest.kind = kind;
  rest.meaning = std::move(meaning);
  return rest;
}

}  // namespace plastron::config
