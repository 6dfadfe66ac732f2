#include <plastron/geometry/pieces.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::geometry {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Interval everything{-infinity, infinity};

/// The range of a part over a box, and whether the part is a single piece there.
struct Range {
  Interval values;
  bool is_one = true;
};

Interval hull(std::initializer_list<double> all) {
  const auto [low, high] = std::minmax(all);
  return std::isnan(low + high) || std::ranges::any_of(all, [](double v) { return std::isnan(v); })
             ? everything
             : Interval{low, high};
}
bool is_zero(const Interval& a) { return a.low == 0 && a.high == 0; }
bool excludes_zero(const Interval& a) { return a.low > 0 || a.high < 0; }

Interval sine(const Interval& a) {
  constexpr double turn = 2 * std::numbers::pi;
  if (!(a.high - a.low < turn)) return {-1, 1};
  const auto has = [&](double place) { return place + turn * std::ceil((a.low - place) / turn) <= a.high; };
  const double at_low = std::sin(a.low), at_high = std::sin(a.high);
  return {has(-turn / 4) ? -1 : std::min(at_low, at_high), has(turn / 4) ? 1 : std::max(at_low, at_high)};
}

Interval power(const Interval& a, const Interval& n) {
  const double exponent = n.low;
  if (n.low == n.high && exponent == std::round(exponent)) {
    if (exponent < 0 && !excludes_zero(a)) return everything;
    const Interval ends = hull({std::pow(a.low, exponent), std::pow(a.high, exponent)});
    return std::fmod(exponent, 2) == 0 && !excludes_zero(a) ? Interval{exponent == 0 ? 1.0 : 0.0, ends.high} : ends;
  }
  if (a.low < 0 || (a.low == 0 && n.low < 0)) return everything;
  return hull({std::pow(a.low, n.low), std::pow(a.low, n.high), std::pow(a.high, n.low), std::pow(a.high, n.high)});
}

using Arguments = std::array<Range, 3>;
using Rule = Range (*)(const Arguments&);

template <double (*f)(double)>
Range increasing(const Arguments& a) {
  return {hull({f(a[0].values.low), f(a[0].values.high)}), a[0].is_one};
}
Range sum(const Arguments& a) {
  return {hull({a[0].values.low + a[1].values.low, a[0].values.high + a[1].values.high}), a[0].is_one && a[1].is_one};
}
Range negative(const Arguments& a) { return {{-a[0].values.high, -a[0].values.low}, a[0].is_one}; }
Range product(const Arguments& a) {
  const Interval &u = a[0].values, &v = a[1].values;
  const auto is_nothing = [](const Range& r) { return is_zero(r.values) && r.is_one; };
  if (is_nothing(a[0]) || is_nothing(a[1])) return {{0, 0}, true};
  return {hull({u.low * v.low, u.low * v.high, u.high * v.low, u.high * v.high}), a[0].is_one && a[1].is_one};
}
Range quotient(const Arguments& a) {
  const Interval& v = a[1].values;
  if (!excludes_zero(v)) return {everything, a[0].is_one && a[1].is_one};
  return product({a[0], Range{{1 / v.high, 1 / v.low}, a[1].is_one}, {}});
}
/// Result of a comparison: 1 if it is `surely` true, 0 if it is `never` true, both possible otherwise.
Range truth(bool surely, bool never) {
  if (surely) return {{1, 1}, true};
  if (never) return {{0, 0}, true};
  return {{0, 1}, false};
}
/// Whether both are the same single number. Other intervals that touch may belong to two pieces, because the border
/// of two boxes may be the border of two pieces.
bool are_same_number(const Interval& u, const Interval& v) {
  return u.low == u.high && v.low == v.high && u.low == v.low;
}
Range less(const Arguments& a) {
  const Interval &u = a[0].values, &v = a[1].values;
  return truth(u.high<v.low, u.low> v.high || are_same_number(u, v));
}
Range less_or_equal(const Arguments& a) {
  const Interval &u = a[0].values, &v = a[1].values;
  return truth(u.high < v.low || are_same_number(u, v), u.low > v.high);
}
Range swapped(const Arguments& a, Rule rule) { return rule({a[1], a[0], {}}); }
Range equal(const Arguments& a) {
  const Interval &u = a[0].values, &v = a[1].values;
  return truth(are_same_number(u, v), u.high < v.low || v.high < u.low);
}
Range opposite(const Range& r) { return {{1 - r.values.high, 1 - r.values.low}, r.is_one}; }
Range conjunction(const Arguments& a) {
  const auto is_true = [](const Range& r) { return excludes_zero(r.values); };
  return truth(is_true(a[0]) && is_true(a[1]), is_zero(a[0].values) || is_zero(a[1].values));
}
Range disjunction(const Arguments& a) {
  return truth(excludes_zero(a[0].values) || excludes_zero(a[1].values), is_zero(a[0].values) && is_zero(a[1].values));
}
Range choice(const Arguments& a) {
  if (excludes_zero(a[0].values)) return a[1];
  if (is_zero(a[0].values)) return a[2];
  return {hull({std::min(a[1].values.low, a[2].values.low), std::max(a[1].values.high, a[2].values.high)}), false};
}
Range magnitude(const Arguments& a) {
  if (a[0].values.low > 0 || is_zero(a[0].values)) return a[0];
  if (a[0].values.high < 0) return negative(a);
  return {{0, std::max(-a[0].values.low, a[0].values.high)}, false};
}
Range largest(const Arguments& a) {
  const Interval &u = a[0].values, &v = a[1].values;
  if (u.low > v.high || are_same_number(u, v)) return a[0];
  if (v.low > u.high) return a[1];
  return {{std::max(u.low, v.low), std::max(u.high, v.high)}, false};
}
Range smallest(const Arguments& a) { return negative({largest({negative(a), negative({a[1], {}, {}}), {}}), {}, {}}); }
Range steps(const Arguments& a, double below, double above) {
  if (a[0].values.low > 0) return {{above, above}, true};
  if (a[0].values.high < 0) return {{below, below}, true};
  return is_zero(a[0].values) ? Range{{(below + above) / 2, (below + above) / 2}, true} : Range{{below, above}, false};
}
Range rounded(const Arguments& a) {
  const double low = std::nearbyint(a[0].values.low), high = std::nearbyint(a[0].values.high);
  return {hull({low, high}), low == high};
}
Range angle(const Arguments& a) {
  const Interval &v = a[0].values, &u = a[1].values;
  if (!excludes_zero(v) && u.low <= 0) return {{-std::numbers::pi, std::numbers::pi}, false};
  return {hull({std::atan2(v.low, u.low), std::atan2(v.low, u.high), std::atan2(v.high, u.low),
                std::atan2(v.high, u.high)}),
          a[0].is_one && a[1].is_one};
}
Range tangent(const Arguments& a) {
  const double half_turns = std::floor(a[0].values.low / std::numbers::pi + 0.5);
  if (!(a[0].values.high < (half_turns + 0.5) * std::numbers::pi)) return {everything, a[0].is_one};
  return increasing<std::tan>(a);
}
Range hyperbolic_cosine(const Arguments& a) {
  const Range m = magnitude(a);
  return {hull({std::cosh(m.values.low), std::cosh(m.values.high)}), a[0].is_one};
}
Range cosine(const Arguments& a) {
  return {sine({a[0].values.low + std::numbers::pi / 2, a[0].values.high + std::numbers::pi / 2}), a[0].is_one};
}

double cubed(double v) { return v * v * v; }

struct Function {
  std::size_t arguments;
  Rule rule;
};

/// Part of an expression: a number, a variable, or a function of other parts.
struct Part {
  enum class Kind { number, variable, call } kind = Kind::number;
  double number = 0;
  Interval Box::*variable = nullptr;
  Rule rule = nullptr;
  std::array<std::size_t, 3> of{};  ///< positions in the list of parts
};

const Function* function_of(std::string_view name) {
  static const std::map<std::string, Function, std::less<>> all{
      {"+", {2, sum}},
      {"negative", {1, negative}},
      {"-",
       {2,
        [](const Arguments& a) {
          return sum({a[0], negative({a[1], {}, {}}), {}});
        }}},
      {"*", {2, product}},
      {"/", {2, quotient}},
      {"^",
       {2,
        [](const Arguments& a) {
          return Range{power(a[0].values, a[1].values), a[0].is_one && a[1].is_one};
        }}},
      {"<", {2, less}},
      {"<=", {2, less_or_equal}},
      {">", {2, [](const Arguments& a) { return swapped(a, less); }}},
      {">=", {2, [](const Arguments& a) { return swapped(a, less_or_equal); }}},
      {"==", {2, equal}},
      {"!=", {2, [](const Arguments& a) { return opposite(equal(a)); }}},
      {"&&", {2, conjunction}},
      {"||", {2, disjunction}},
      {"?", {3, choice}},
      {"abs", {1, magnitude}},
      {"max", {2, largest}},
      {"min", {2, smallest}},
      {"sign", {1, [](const Arguments& a) { return steps(a, -1, 1); }}},
      {"step", {1, [](const Arguments& a) { return steps(a, 0, 1); }}},
      {"rint", {1, rounded}},
      {"atan2", {2, angle}},
      {"sin",
       {1,
        [](const Arguments& a) {
          return Range{sine(a[0].values), a[0].is_one};
        }}},
      {"cos", {1, cosine}},
      {"tan", {1, tangent}},
      {"cosh", {1, hyperbolic_cosine}},
      {"sq",
       {1,
        [](const Arguments& a) {
          return Range{power(a[0].values, {2, 2}), a[0].is_one};
        }}},
      {"cube", {1, increasing<cubed>}},
      {"asin", {1, increasing<std::asin>}},
      {"acos", {1, increasing<std::acos>}},  // its ends are exchanged in the hull
      {"atan", {1, increasing<std::atan>}},
      {"sinh", {1, increasing<std::sinh>}},
      {"tanh", {1, increasing<std::tanh>}},
      {"asinh", {1, increasing<std::asinh>}},
      {"acosh", {1, increasing<std::acosh>}},
      {"atanh", {1, increasing<std::atanh>}},
      {"exp", {1, increasing<std::exp>}},
      {"log", {1, increasing<std::log>}},
      {"ln", {1, increasing<std::log>}},
      {"sqrt", {1, increasing<std::sqrt>}}};
  const auto found = all.find(name);
  return found == all.end() ? nullptr : &found->second;
}

/// Recursive descent, one function per precedence of muParser, which has accepted the text. Unknown syntax is
/// reported as no expression.
class Reading {
 public:
  Reading(std::string_view text, const std::map<std::string, double>& constants) : text_(text), constants_(constants) {}

  std::optional<std::vector<Part>> operator()() {
    chosen();
    skip();
    if (at_ < text_.size() || fails_) return {};
    return std::move(parts_);
  }

 private:
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(std::string_view word) {
    skip();
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  std::size_t add(Part part) {
    parts_.push_back(part);
    return parts_.size() - 1;
  }
  std::size_t call(std::string_view name, std::array<std::size_t, 3> of) {
    return add({.kind = Part::Kind::call, .rule = function_of(name)->rule, .of = of});
  }
  std::size_t failed() {
    fails_ = true;
    at_ = text_.size();
    return add({});
  }

  std::size_t chosen() {
    const std::size_t condition = chain(0);
    if (!take("?")) return condition;
    const std::size_t yes = chosen();
    if (!take(":")) return failed();
    return call("?", {condition, yes, chosen()});
  }

  /// Parses operators of one precedence, from the left.
  std::size_t chain(std::size_t precedence) {
    static const std::vector<std::vector<std::string_view>> operators{
        {"||"}, {"&&"}, {"<=", ">=", "!=", "==", "<", ">"}, {"+", "-"}, {"*", "/"}};
    if (precedence == operators.size()) return signed_power();
    std::size_t left = chain(precedence + 1);
    for (;;) {
      const auto& all = operators[precedence];
      const auto found = std::ranges::find_if(all, [&](std::string_view word) { return take(word); });
      if (found == all.end()) return left;
      const std::size_t right = chain(precedence + 1);
      left = call(*found, {left, right, 0});
    }
  }

  std::size_t signed_power() {
    if (take("-")) return call("negative", {signed_power(), 0, 0});
    if (take("+")) return signed_power();
    const std::size_t base = operand();
    return take("^") ? call("^", {base, signed_power(), 0}) : base;
  }

  std::size_t operand() {
    if (take("(")) {
      const std::size_t inner = chosen();
      return take(")") ? inner : failed();
    }
    skip();
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (at_ < text_.size() && !std::isalpha(static_cast<unsigned char>(text_[at_])) && error == std::errc()) {
      at_ = static_cast<std::size_t>(end - text_.data());
      return add({.number = value});
    }
    return named();
  }

  std::size_t named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    if (take("(")) return function(name);
    if (const auto found = constants_.find(name); found != constants_.end()) return add({.number = found->second});
    static const std::map<std::string, Interval Box::*> variables{
        {"x", &Box::x}, {"y", &Box::y}, {"X", &Box::X}, {"Y", &Box::Y}, {"Z", &Box::Z}};
    const auto variable = variables.find(name);
    if (variable == variables.end()) return failed();
    return add({.kind = Part::Kind::variable, .variable = variable->second});
  }

  /// Parses a function's arguments; min and max have any number of them.
  std::size_t function(const std::string& name) {
    const Function* known = function_of(name);
    if (!known) return failed();
    std::vector<std::size_t> arguments{chosen()};
    while (take(",")) arguments.push_back(chosen());
    if (!take(")")) return failed();
    if (name == "min" || name == "max") {
      std::size_t all = arguments[0];
      for (std::size_t k = 1; k < arguments.size(); ++k) all = call(name, {all, arguments[k], 0});
      return all;
    }
    if (arguments.size() != known->arguments) return failed();
    arguments.resize(3);
    return call(name, {arguments[0], arguments[1], arguments[2]});
  }

  std::string_view text_;
  const std::map<std::string, double>& constants_;
  std::vector<Part> parts_{};
  std::size_t at_ = 0;
  bool fails_ = false;
};

}  // namespace

struct Pieces::Program {
  std::vector<Part> parts;  ///< each after the parts that it uses
};

Pieces::Pieces(const Expression& f) {
  if (!is_piecewise(f)) return;
  const std::map<std::string, double> constants = f.constants();
  auto parts = Reading(f.text(), constants)();
  known_ = parts.has_value();
  if (parts) program_ = std::make_shared<const Program>(Program{std::move(*parts)});
}

bool Pieces::is_one_over(const Box& box) const {
  if (!program_) return known_;
  thread_local std::vector<Range> ranges;
  ranges.clear();
  for (const Part& part : program_->parts) switch (part.kind) {
      case Part::Kind::number:
        ranges.push_back({{part.number, part.number}});
        break;
      case Part::Kind::variable:
        ranges.push_back({box.*part.variable});
        break;
      case Part::Kind::call:
        ranges.push_back(part.rule({ranges[part.of[0]], ranges[part.of[1]], ranges[part.of[2]]}));
    }
  return ranges.back().is_one;
}

bool is_piecewise(const Expression& f) {
  constexpr std::array<std::string_view, 7> words{"abs", "atan2", "max", "min", "rint", "sign", "step"};
  const auto in_a_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  if (f.is_constant()) return false;
  const std::string_view text = f.text();
  if (text.find_first_of("?<>=!&|") != std::string_view::npos) return true;
  for (auto begin = text.begin(); begin != text.end();) {
    begin = std::find_if(begin, text.end(), in_a_name);
    const auto end = std::find_if_not(begin, text.end(), in_a_name);
    if (std::ranges::find(words, std::string_view(begin, end)) != words.end()) return true;
    begin = end;
  }
  return false;
}

}  // namespace plastron::geometry
