#include <fmt/format.h>
#include <plastron/config/schema.hpp>

namespace plastron::config {

namespace {

constexpr const char* introduction = R"manual(# The case file

<!-- Generated from src/plastron/config by tests/config (PLASTRON_WRITE_DOCS=1); change it there. -->

A case file is a [TOML](https://toml.io) file that defines one computation. An unknown key, a wrong type or a value out of
range is an error. All mistakes of a file are reported together, each with its line, the allowed values and advice.
`plastron explain shell.thickness` prints the entry of a key, `plastron schema` prints the schema for editors ([command-line.md](command-line.md)).

```toml
title = "Spherical bowl pressed on a table"

[constants]
R = 1.0
edge = "0.5*R"                      # a constant may use those above it

[shell]
E = 1.0
nu = 0.3
thickness = 0.02

[geometry]
domain = { disk = { radius = "sin(edge)" } }
chart = ["x", "y", "0.02 + R - sqrt(R^2 - x^2 - y^2)"]

[mesh]
degree = 3
refinements = 4

[[support]]
boundary = "rim"
fix = ["u.x", "u.y"]
values = { u.x = "1e-3*x" }         # a component without a value is 0

[[load]]
force = [0, 0, "-2e-3"]

[[obstacle]]
half_space = { point = [0, 0, 0], normal = [0, 0, 1] }

[[probe]]
name = "quarter"
at = ["sin(0.25)", 0]
```

Use the units of the tables, or any other consistent units. Lengths in the plane of the parameters have the unit of x and y.

## Expressions

Every number may also be an expression in quotes: `"2*sin(R/2)"`. Where the tables below say so, it may use the parameters
x and y. An expression consists of

- numbers, pi, the constants of `[constants]`, and x and y where allowed;
- `+ - * / ^`, comparisons `== != < <= > >=`, `&& ||`, and the choice `condition ? a : b`;
- sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log ln sqrt abs, and min max sign; log and ln
  are both the natural logarithm.

A chart is differentiated twice. Therefore it has no comparisons, choices, min, max or sign, no exponent beyond 1000 and no
product of dozens of factors. An expression has at most 4000 characters and 50 nested brackets.

## Limits

A file has at most 256 kB and 500 sections. A list or a table has at most 500 entries, a name at most 60 bytes.
The coarsest mesh of a rectangle has at most a million cells.
)manual";

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string allowed(const Key& key) { return key.words.empty() ? code(allowed_values(key)) : allowed_values(key); }

std::string fallback(const Key& key) { return key.required ? "required" : code(key.fallback); }

std::string heading(const Section& section) {
  const std::string depth = section.path.find('.') == std::string::npos ? "##" : "###";
  if (section.path.empty()) return "## Sections";
  return depth + " " + (section.header.starts_with('[') ? section.header : code(section.path));
}

std::string describe(const Section& section) {
  std::string text = fmt::format("\n{}\n\n{}\n", heading(section), section.meaning);
  if (section.keys.empty()) return text;
  text += "\n| key | value | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n";
  for (const Key& key : section.keys)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(key.name), description(key.kind), key.unit,
                        fallback(key), allowed(key), key.meaning);
  if (!section.other_keys.empty()) text += fmt::format("\nOther keys are {}.\n", section.other_keys);
  return text;
}

}  // namespace

std::string describe_case_format() {
  std::string text = introduction;
  for (const Section& section : sections()) text += describe(section);
  return text;
}

}  // namespace plastron::config
