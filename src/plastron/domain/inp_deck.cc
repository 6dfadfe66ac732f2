#include <plastron/domain/inp_deck.hpp>
#include <plastron/domain/inp_lines.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace plastron::domain {

namespace {

using geometry::shown;

/// Keywords without which nodes or elements would be missing or would lie elsewhere, with the way out.
constexpr std::pair<const char*, const char*> refused_keywords[] = {
    {"INCLUDE", "put the whole mesh in one file"},
    {"SYSTEM", "give the coordinates of all nodes in the global system"},
    {"NGEN", "list all nodes by *NODE"},
    {"NFILL", "list all nodes by *NODE"},
    {"NCOPY", "list all nodes by *NODE"},
    {"NMAP", "list all nodes by *NODE at their places"},
    {"ELGEN", "list all elements by *ELEMENT"},
    {"ELCOPY", "list all elements by *ELEMENT"},
    {"SYMMETRIC MODEL GENERATION", "list all nodes and elements"},
    {"IMPORT", "list all nodes and elements"}};

/// Sections of shells and of elements that are read as shells. They name the regions.
constexpr const char* section_keywords[] = {"SHELL SECTION", "SHELL GENERAL SECTION", "MEMBRANE SECTION",
                                            "SOLID SECTION", "SURFACE SECTION"};

/// Keywords without meaning for the mesh, which no note mentions.
constexpr const char* silent_keywords[] = {"HEADING",      "PREPRINT",     "END PART",
                                           "END INSTANCE", "END ASSEMBLY", "END STEP"};

/// Trusses, beams, pipes, shells and rigid bodies of revolution: the start of their names, nodes without that of a beam's
/// direction.
constexpr std::pair<const char*, int> line_types[] = {
    {"T2D2", 2}, {"T2D3", 3}, {"T3D2", 2}, {"T3D3", 3},   {"B21", 2},    {"B22", 3},    {"B23", 2},
    {"B31", 2},  {"B32", 3},  {"B33", 2},  {"PIPE21", 2}, {"PIPE22", 3}, {"PIPE31", 2}, {"PIPE32", 3},
    {"SAX1", 2}, {"SAX2", 3}, {"MAX1", 2}, {"MAX2", 3},   {"RAX2", 2},   {"R2D2", 2}};

/// Returns the number at the begin of a text; 0 without digits.
int leading_number(std::string_view text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

InpElementType cell_of(int nodes, bool is_plane) {
  const int number = nodes == 3 ? 2 : nodes == 4 ? 3 : nodes == 6 ? 9 : nodes == 8 ? 16 : 10;
  return {InpKind::cell, nodes, number, is_plane};
}

/// Reads an input file block by block.
class InpReader {
 public:
  explicit InpReader(const std::string& path) : lines_(path) { deck_.path = path; }

  InpDeck read() {
    if (lines_.at_end()) throw mesh::DomainError(fmt::format("{}: the input file is empty", deck_.path));
    while (!lines_.at_end()) block(lines_.keyword());
    return std::move(deck_);
  }

 private:
  // Each of these functions starts at its keyword and ends at the next one.
  void block(const InpKeyword& keyword);
  void part(const InpKeyword& keyword);
  void instance(const InpKeyword& keyword);
  void nodes(const InpKeyword& keyword);
  void elements(const InpKeyword& keyword);
  void set(const InpKeyword& keyword, InpSets& sets, const char* parameter, const char* what);
  void surface(const InpKeyword& keyword);
  void normals(const InpKeyword& keyword);
  void section(const InpKeyword& keyword);
  void leave_unread(const std::string& name);

  void refuse_missing_data(const InpKeyword& keyword) const;
  std::string required(const InpKeyword& keyword, const char* parameter) const;
  std::size_t type_number(const std::string& name);
  void check_owner(const char* what);
  void element(std::size_t type, InpSet* of_block);
  void generate(InpSet& set, bool is_counted) const;
  void add_member(InpSet& set, const InpMember& member, bool is_counted) const;
  InpMember member(std::size_t i, const char* what, InpLevel level) const;
  void element_surface(const std::string& name);
  void node_surface(const std::string& name);

  InpLevel level() const { return has_assembly_ && owner_.empty() ? InpLevel::assembly : InpLevel::part; }

  InpLines lines_;
  InpDeck deck_{};
  std::string owner_{};  ///< *PART or *INSTANCE of the current block, like "part PANEL"; empty outside
  std::optional<std::string> mesh_owner_{};            ///< that of the nodes
  std::map<std::string, std::size_t> type_numbers_{};  ///< index in InpDeck::types by name
  bool has_assembly_ = false;
};

void InpReader::block(const InpKeyword& keyword) {
  const std::string& name = keyword.name;
  for (const auto& [refused, advice] : refused_keywords)
    if (name == refused) lines_.refuse(fmt::format("*{} is not read; {}", name, advice));
  if (name == "PART") return part(keyword);
  if (name == "INSTANCE") return instance(keyword);
  if (name == "NODE") return nodes(keyword);
  if (name == "ELEMENT") return elements(keyword);
  if (name == "NSET") return set(keyword, deck_.node_sets, "NSET", "a node's number or the name of a set of nodes");
  if (name == "ELSET")
    return set(keyword, deck_.element_sets, "ELSET", "an element's number or the name of a set of elements");
  if (name == "SURFACE") return surface(keyword);
  if (name == "NORMAL") return normals(keyword);
  if (std::ranges::find(section_keywords, name) != std::end(section_keywords)) return section(keyword);
  if (name == "ASSEMBLY") has_assembly_ = true;
  if (name == "END PART" || name == "END INSTANCE" || name == "ASSEMBLY" || name == "END ASSEMBLY") owner_.clear();
  if (name == "ASSEMBLY" || std::ranges::find(silent_keywords, name) != std::end(silent_keywords))
    return lines_.skip_data();
  leave_unread(name);
}

void InpReader::leave_unread(const std::string& name) {
  ++deck_.unread[shown(name)];
  lines_.skip_data();
}

void InpReader::refuse_missing_data(const InpKeyword& keyword) const {
  if (keyword.has("INPUT"))
    lines_.refuse(
        fmt::format("*{} takes its data from another file (INPUT); put the whole mesh in one file", keyword.name));
}

std::string InpReader::required(const InpKeyword& keyword, const char* parameter) const {
  const auto value = keyword.value(parameter);
  if (!value) lines_.refuse(fmt::format("*{} has no parameter {}", keyword.name, parameter));
  return checked_name(lines_.text(), *value);
}

void InpReader::part(const InpKeyword& keyword) {
  owner_ = "part " + required(keyword, "NAME");
  lines_.skip_data();
}

void InpReader::instance(const InpKeyword& keyword) {
  const std::string name = required(keyword, "NAME");
  if (!deck_.instance.empty())
    lines_.refuse(
        fmt::format("\"{}\" is a second instance; one is read. Merge the instances to one part, or save the file "
                    "without parts and assemblies",
                    name));
  deck_.instance = name;
  has_assembly_ = true;
  owner_ = "instance " + name;
  while (lines_.next_data())
    for (std::size_t i = 0; i < lines_.field_count(); ++i)
      if (lines_.real(i, "a translation or a rotation of the instance") != 0)
        lines_.refuse(
            fmt::format("the instance \"{}\" is moved or turned, which is not read; save the file without parts and "
                        "assemblies",
                        name));
}

void InpReader::check_owner(const char* what) {
  if (!mesh_owner_) mesh_owner_ = owner_;
  if (*mesh_owner_ != owner_)
    lines_.refuse(
        fmt::format("there are {} in \"{}\" and before in \"{}\"; one part is read. Merge the parts to one, or save "
                    "the file without parts and assemblies",
                    what, owner_, *mesh_owner_));
}

void InpReader::nodes(const InpKeyword& keyword) {
  refuse_missing_data(keyword);
  const auto system = keyword.value("SYSTEM");
  if (system && capitals(*system) != "R")
    lines_.refuse(fmt::format("*NODE has SYSTEM={}; only rectangular coordinates (SYSTEM=R) are read", shown(*system)));
  const bool is_of_assembly = level() == InpLevel::assembly;
  if (!is_of_assembly) check_owner("nodes");
  InpSet* const set = keyword.has("NSET") ? &deck_.node_sets.at(level(), required(keyword, "NSET")) : nullptr;
  while (lines_.next_data()) {
    const std::int64_t tag = lines_.label(0, "a node's number");
    if (lines_.field_count() < 2 || lines_.field_count() > 7)
      lines_.refuse(
          fmt::format("node {} has {} numbers after its own; 1 to 3 coordinates and, after these, the 3 "
                      "components of a normal are allowed",
                      tag, lines_.field_count() - 1));
    Eigen::Vector3d x, normal;
    for (const std::size_t k : {0, 1, 2}) {
      x[k] = lines_.real(k + 1, "a coordinate");
      normal[k] = lines_.real(k + 4, "a component of a normal");
    }
    deck_.assembly_nodes += is_of_assembly;
    if (is_of_assembly) continue;
    deck_.nodes.push_back({tag, x});
    if (!normal.isZero(0)) deck_.node_normals.emplace_back(tag, normal);
    if (set) set->add(tag);
  }
}

std::size_t InpReader::type_number(const std::string& name) {
  const auto [found, is_new] = type_numbers_.try_emplace(name, deck_.types.size());
  if (is_new) deck_.types.push_back({name, inp_element_type(name)});
  return found->second;
}

void InpReader::elements(const InpKeyword& keyword) {
  refuse_missing_data(keyword);
  const std::size_t type = type_number(capitals(required(keyword, "TYPE")));
  const InpKind kind = deck_.types[type].type.kind;
  const bool is_of_assembly = level() == InpLevel::assembly;
  if (is_of_assembly && kind == InpKind::cell)
    lines_.refuse("the assembly has shell elements outside of its instance; put all of them in one part");
  if (kind == InpKind::cell) check_owner("elements");
  InpSet* const set = keyword.has("ELSET") ? &deck_.element_sets.at(level(), required(keyword, "ELSET")) : nullptr;
  while (lines_.next_data()) element(type, is_of_assembly ? nullptr : set);
}

void InpReader::element(std::size_t type, InpSet* of_block) {
  InpDeck::Type& known = deck_.types[type];
  const InpKind kind = known.type.kind;
  const bool is_counted = kind == InpKind::cell || kind == InpKind::volume;
  const std::size_t wanted = is_counted ? static_cast<std::size_t>(known.type.nodes) : 0;
  const bool is_of_assembly = level() == InpLevel::assembly;
  const bool has_nodes = !is_of_assembly && (kind == InpKind::cell || kind == InpKind::line);
  InpElement element{lines_.label(0, "an element's number"), lines_.line_number(), type, deck_.element_nodes.size()};
  bool is_complete = false;
  for (std::size_t i = 1; !is_complete; i = 0) {
    for (; i < lines_.field_count(); ++i, ++element.nodes)
      if (has_nodes) deck_.element_nodes.push_back(lines_.label(i, "a node's number"));
    if (wanted > 0 && element.nodes > wanted)
      lines_.refuse(fmt::format("element {} has {} nodes; the type {} has {}", element.tag, element.nodes,
                                shown(known.name), wanted));
    is_complete = wanted > 0 ? element.nodes == wanted : !lines_.ends_with_comma();
    if (!is_complete && !lines_.next_data()) {
      if (wanted > 0)
        lines_.refuse(fmt::format("the block ends after {} of the {} nodes of element {} (line {}) of type {}",
                                  element.nodes, wanted, element.tag, element.line, shown(known.name)));
      break;
    }
  }
  if (!has_nodes) element.nodes = 0;
  ++known.count;
  if (is_of_assembly) return;  // a mass or a spring, whose number may be that of a shell
  deck_.elements.push_back(element);
  if (of_block) of_block->add(element.tag);
}

InpMember InpReader::member(std::size_t i, const char* what, InpLevel level) const {
  if (lines_.is_label(i)) return {lines_.label(i, what), {"", level, lines_.line_number()}};
  std::string_view text = lines_.field(i);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::string name = capitals(checked_name(lines_.text(), text));
  const std::string prefix = capitals(deck_.instance) + ".";
  if (prefix.size() > 1 && name.starts_with(prefix)) {
    name.erase(0, prefix.size());
    level = InpLevel::part;
  }
  std::int64_t number = 0;
  if (!geometry::parse(std::string_view(name), number)) return {0, {name, level, lines_.line_number()}};
  if (number < 1 || number > largest_label)
    lines_.refuse(fmt::format("found \"{}\" where {} should stand", shown(lines_.field(i)), what));
  return {number, {"", level, lines_.line_number()}};
}

void InpReader::add_member(InpSet& set, const InpMember& member, bool is_counted) const {
  if (member.number == 0)
    set.sets.push_back(member.set);
  else if (is_counted || member.set.level == InpLevel::part)
    set.add(member.number);
}

void InpReader::generate(InpSet& set, bool is_counted) const {
  InpRange range{lines_.label(0, "the first number"), lines_.label(1, "the last number"), 1};
  if (!lines_.field(2).empty()) range.step = lines_.label(2, "the step");
  if (range.last < range.first || lines_.field_count() > 3)
    lines_.refuse(
        fmt::format("found \"{}\"; with GENERATE a line has the first number, the last number, which is not "
                    "smaller, and a step",
                    shown(lines_.text().line())));
  if (is_counted) set.ranges.push_back(range);
}

void InpReader::set(const InpKeyword& keyword, InpSets& sets, const char* parameter, const char* what) {
  const std::string name = required(keyword, parameter);
  const auto instance = keyword.value("INSTANCE");
  if (instance && capitals(*instance) != capitals(deck_.instance))
    lines_.refuse(
        fmt::format("the set \"{}\" belongs to the instance \"{}\", which does not exist", name, shown(*instance)));
  InpSet& set = sets.at(level(), name);
  set.is_listed = true;
  set.is_internal = keyword.has("INTERNAL");
  // A set of the assembly without an instance holds numbers of the assembly's own nodes and elements.
  const bool is_counted = level() == InpLevel::part || instance;
  if (&sets == &deck_.node_sets && keyword.has("ELSET"))
    set.nodes_of.push_back({capitals(required(keyword, "ELSET")), instance ? InpLevel::part : level(), keyword.line});
  while (lines_.next_data())
    if (keyword.has("GENERATE"))
      generate(set, is_counted);
    else
      for (std::size_t i = 0; i < lines_.field_count(); ++i)
        if (!lines_.field(i).empty()) add_member(set, member(i, what, instance ? InpLevel::part : level()), is_counted);
}

void InpReader::surface(const InpKeyword& keyword) {
  const std::string name = required(keyword, "NAME");
  const std::string type = capitals(keyword.value("TYPE").value_or("ELEMENT"));
  if (keyword.has("COMBINE") || keyword.has("CROP")) return leave_unread("SURFACE, COMBINE");
  if (type == "ELEMENT") return element_surface(name);
  if (type == "NODE") return node_surface(name);
  leave_unread("SURFACE, TYPE=" + type);
}

void InpReader::element_surface(const std::string& name) {
  InpSurface surface{name, level()};
  while (lines_.next_data())
    surface.entries.push_back({member(0, "an element's number or the name of a set of elements", level()),
                               capitals(lines_.field(1)), lines_.line_number()});
  deck_.surfaces.push_back(std::move(surface));
}

void InpReader::node_surface(const std::string& name) {
  InpSet& set = deck_.node_surfaces.at(level(), name);
  while (lines_.next_data())
    add_member(set, member(0, "a node's number or the name of a set of nodes", level()), level() == InpLevel::part);
}

void InpReader::normals(const InpKeyword& keyword) {
  const std::string type = capitals(keyword.value("TYPE").value_or("ELEMENT"));
  if (type == "CONTACT SURFACE") return leave_unread("NORMAL, TYPE=CONTACT SURFACE");
  if (type != "ELEMENT") lines_.refuse(fmt::format("*NORMAL has TYPE={}; TYPE=ELEMENT is read", shown(type)));
  while (lines_.next_data()) {
    InpNormal normal{member(0, "an element's number or the name of a set of elements", level()),
                     member(1, "a node's number or the name of a set of nodes", level())};
    for (const std::size_t k : {0, 1, 2}) normal.direction[k] = lines_.real(k + 2, "a component of a normal");
    if (normal.direction.isZero(0))
      lines_.refuse(fmt::format("the line \"{}\" has no normal, or one of length 0", shown(lines_.text().line())));
    deck_.normals.push_back(std::move(normal));
  }
}

void InpReader::section(const InpKeyword& keyword) {
  if (const auto elset = keyword.value("ELSET"); elset) {
    deck_.sections.push_back({capitals(checked_name(lines_.text(), *elset)), level(), keyword.line});
    double offset = 0;
    const auto shift = keyword.value("OFFSET");
    if (shift && !(geometry::parse(*shift, offset) && offset == 0))
      deck_.notes.push_back(
          fmt::format("the section of \"{}\" (line {}) has OFFSET={}, which is not read: the nodes are taken to lie on "
                      "the mid-surface",
                      *elset, keyword.line, shown(*shift)));
  }
  leave_unread(keyword.name);
}

}  // namespace

InpElementType inp_element_type(std::string_view name) {
  if (name == "STRI3" || name == "STRI35") return cell_of(3, false);
  if (name == "STRI65") return cell_of(6, false);
  for (const char* prefix : {"SFM3D", "M3D", "CPS", "CPE", "DS", "S"}) {
    if (!name.starts_with(prefix)) continue;
    const std::string_view rest = name.substr(std::string_view(prefix).size());
    const std::size_t end = std::min(rest.find_first_not_of("0123456789"), rest.size());
    const bool is_known = end == 1 && std::string_view("34689").find(rest[0]) != std::string_view::npos;
    // R: reduced integration, 5: five degrees of freedom at a node, T, H, I, P, W, F, S: other variants
    if (is_known && rest.find_first_not_of("R5THIPWFSM", 1) == std::string_view::npos)
      return cell_of(rest[0] - '0', name.starts_with("CP"));
  }
  for (const char* prefix : {"C3D", "F3D", "SC", "CSS"})
    if (const std::size_t at = name.find(prefix); at <= 2) {
      const int nodes = leading_number(name.substr(at + std::string_view(prefix).size()));
      if (nodes >= 4 && nodes <= 27) return {InpKind::volume, nodes < 27 ? nodes : 0};  // C3D27 has 21 to 27
    }
  for (const auto& [prefix, nodes] : line_types)
    if (name.starts_with(prefix)) return {InpKind::line, nodes};
  return {};
}

void InpSet::add(std::int64_t number) {
  if (!ranges.empty() && ranges.back().step == 1 && ranges.back().last + 1 == number)
    ++ranges.back().last;
  else
    ranges.push_back({number, number, 1});
}

InpSet& InpSets::at(InpLevel level, const std::string& name) {
  const auto [found, is_new] = number_of.try_emplace({level, capitals(name)}, all.size());
  if (is_new) all.push_back({.name = name, .level = level});
  return all[found->second];
}

InpDeck read_inp_deck(const std::string& path) { return InpReader(path).read(); }

}  // namespace plastron::domain
