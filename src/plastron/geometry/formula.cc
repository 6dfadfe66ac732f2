#include "formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::geometry {

namespace {

using GiNaC::ex;

// |f| and sign f of real f, with |f|' = sign(f) f' and sign' = 0. They are finite where f is zero, unlike GiNaC's f
// f' / |f|, so that f |f| has both derivatives there. The kink of |f| is detected in the examination of charts.

unsigned sign_serial() {
  static const auto derivative = [](const ex&, unsigned) -> ex { return 0; };
  static const unsigned serial =
      GiNaC::function::register_new(GiNaC::function_options("sign_of_real", 1).derivative_func(+derivative));
  return serial;
}

unsigned magnitude_serial() {
  static const auto derivative = [](const ex& f, unsigned) -> ex { return GiNaC::function(sign_serial(), f); };
  static const unsigned serial =
      GiNaC::function::register_new(GiNaC::function_options("magnitude_of_real", 1).derivative_func(+derivative));
  return serial;
}

/// The absolute value; numbers stay exact.
ex magnitude(const ex& f) {
  return GiNaC::is_a<GiNaC::numeric>(f) ? ex(GiNaC::abs(f)) : ex(GiNaC::function(magnitude_serial(), f));
}

ex call(const std::string& name, const std::vector<ex>& arguments) {
  static const std::map<std::string, ex (*)(const ex&)> functions{{"sin", [](const ex& a) { return ex(GiNaC::sin(a)); }},
                                                                  {"cos", [](const ex& a) { return ex(GiNaC::cos(a)); }},
                                                                  {"tan", [](const ex& a) { return ex(GiNaC::tan(a)); }},
                                                                  {"asin", [](const ex& a) { return ex(GiNaC::asin(a)); }},
                                                                  {"acos", [](const ex& a) { return ex(GiNaC::acos(a)); }},
                                                                  {"atan", [](const ex& a) { return ex(GiNaC::atan(a)); }},
                                                                  {"sinh", [](const ex& a) { return ex(GiNaC::sinh(a)); }},
                                                                  {"cosh", [](const ex& a) { return ex(GiNaC::cosh(a)); }},
                                                                  {"tanh", [](const ex& a) { return ex(GiNaC::tanh(a)); }},
                                                                  {"asinh", [](const ex& a) { return ex(GiNaC::asinh(a)); }},
                                                                  {"acosh", [](const ex& a) { return ex(GiNaC::acosh(a)); }},
                                                                  {"atanh", [](const ex& a) { return ex(GiNaC::atanh(a)); }},
                                                                  {"exp", [](const ex& a) { return ex(GiNaC::exp(a)); }},
                                                                  {"log", [](const ex& a) { return ex(GiNaC::log(a)); }},
                                                                  {"ln", [](const ex& a) { return ex(GiNaC::log(a)); }},
                                                                  {"sqrt", [](const ex& a) { return GiNaC::sqrt(a); }},
                                                                  {"abs", [](const ex& a) { return magnitude(a); }}};
  if (name == "atan2" && arguments.size() == 2) return GiNaC::atan2(arguments[0], arguments[1]);
  const auto found = functions.find(name);
  if (found == functions.end() || arguments.size() != 1)
    throw std::invalid_argument(fmt::format("\"{}\" has no derivatives", name));
  return found->second(arguments[0]);
}

/// Refuses numbers of extreme length: GiNaC computes with whole numbers of any length, which could fill the memory.
void check_digits(const ex& e) {
  constexpr int most_bits = 2000;
  const auto too_long = [](const ex& part) {
    return GiNaC::is_a<GiNaC::numeric>(part) && GiNaC::ex_to<GiNaC::numeric>(part).is_rational() &&
           std::max(GiNaC::ex_to<GiNaC::numeric>(part).numer().int_length(),
                    GiNaC::ex_to<GiNaC::numeric>(part).denom().int_length()) > most_bits;
  };
  bool refused = too_long(e);
  for (std::size_t i = 0; i < e.nops() && !refused; ++i) refused = too_long(e.op(i));
  if (refused) throw std::invalid_argument("its numbers have more than 600 digits");
}

ex power(const ex& base, const ex& exponent) {
  constexpr int largest_exponent = 1000;
  if (GiNaC::is_a<GiNaC::numeric>(exponent) && GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(exponent)) > largest_exponent)
    throw std::invalid_argument("an exponent is larger than 1000");
  ex result = GiNaC::pow(base, exponent);
  check_digits(result);
  return result;
}

/// Recursive descent, one function per precedence. Expressions are short and have few brackets (expression.hpp), so
/// the recursion is shallow. Only signs and exponents could nest deeply; they are counted.
class Parser {
 public:
  Parser(std::string_view text, const std::map<std::string, ex>& names) : text_(text), names_(names) {}

  ex whole() {
    ex result = sum();
    if (next() != 0) throw std::invalid_argument(fmt::format("\"{}\" has no derivatives", next()));
    return result;
  }

 private:
  /// Counts the nesting of signs and exponents.
  struct Level {
    explicit Level(Parser& of) : parser(of) {
      constexpr int deepest = 200;
      if (++parser.depth_ > deepest) throw std::invalid_argument("it has too many signs or exponents in each other");
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --parser.depth_; }
    Parser& parser;
  };

  /// Returns the next character that is not blank, 0 at the end.
  char next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) throw std::invalid_argument(fmt::format("\"{}\" has no derivatives", next()));
  }

  ex sum() {
    ex left = product();
    for (;;) {
      if (take('+'))
        left = left + product();
      else if (take('-'))
        left = left - product();
      else
        return left;
    }
  }
  ex product() {
    ex left = signed_power();
    for (;;) {
      if (take('*'))
        check_digits(left = left * signed_power());
      else if (take('/'))
        check_digits(left = left / signed_power());
      else
        return left;
    }
  }
  ex signed_power() {
    const Level level(*this);
    if (take('-')) return -signed_power();
    if (take('+')) return signed_power();
    const ex base = operand();
    return take('^') ? power(base, signed_power()) : base;
  }
  ex operand() {
    if (take('(')) {
      ex inner = sum();
      expect(')');
      return inner;
    }
    return std::isdigit(static_cast<unsigned char>(next())) || next() == '.' ? number() : named();
  }

  /// Reads a number; whole numbers stay exact.
  ex number() {
    std::size_t length = 0;
    const std::string rest(text_.substr(at_));
    const double value = std::stod(rest, &length);
    const std::string digits = rest.substr(0, length);
    at_ += length;
    const bool whole = digits.find_first_not_of("0123456789") == std::string::npos;
    ex result = whole ? GiNaC::numeric(digits.c_str()) : GiNaC::numeric(value);
    check_digits(result);
    return result;
  }
  ex named() {
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_')) ++end;
    const std::string name(text_.substr(at_, end - at_));
    at_ = end;
    if (!take('(')) {
      if (const auto found = names_.find(name); found != names_.end()) return found->second;
      throw std::invalid_argument(
          fmt::format("\"{}\" has no derivatives", name.empty() ? std::string(1, next()) : name));
    }
    std::vector<ex> arguments{sum()};
    while (take(',')) arguments.push_back(sum());
    expect(')');
    return call(name, arguments);
  }

  std::string_view text_;
  const std::map<std::string, ex>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// Upper estimates of the number of nodes of a formula and of its derivatives with respect to one variable. A product of
/// n factors has n^2 terms in its second derivative, each as long as the product; nested functions multiply in a similar
/// way.
struct DerivativeSize {
  double value = 1, first = 0, second = 0;
};

DerivativeSize derivative_size(const GiNaC::ex& e);

/// f(g): f' g', then f'' g' g' + f' g''. The derivatives of f contain f and g a few times.
DerivativeSize composed(const DerivativeSize& g) {
  constexpr double of_function = 4;
  const double f = of_function * (1 + g.value);
  return {1 + g.value, g.first > 0 ? f + g.first : 0, g.first > 0 ? 2 * f + 2 * g.first + g.second : 0};
}

DerivativeSize sum_of(const DerivativeSize& a, const DerivativeSize& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

/// Leibniz's rule for all factors at once.
DerivativeSize product(const GiNaC::ex& e) {
  DerivativeSize all{.value = 1};
  double varying = 0;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const DerivativeSize factor = derivative_size(e.op(i));
    all = sum_of(all, factor);
    if (factor.first > 0) varying += 1;
  }
  return {all.value, all.first + varying * all.value,
          all.second + 2 * varying * all.first + varying * varying * all.value};
}

DerivativeSize derivative_size(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return {1, 1, 0};
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  DerivativeSize all{.value = 1};
  for (std::size_t i = 0; i < e.nops(); ++i) all = sum_of(all, derivative_size(e.op(i)));
  return GiNaC::is_a<GiNaC::add>(e) || e.nops() == 0 ? all : composed(all);
}

std::string number(const GiNaC::numeric& value) {
  if (!value.is_real()) throw std::invalid_argument("it has a complex coefficient");
  return fmt::format("({:.17g})", value.to_double());
}

std::string power_in_words(const GiNaC::ex& base, const GiNaC::ex& exponent) {
  std::string b = in_muparser_syntax(base);
  if (GiNaC::is_a<GiNaC::numeric>(exponent)) {
    const auto n = GiNaC::ex_to<GiNaC::numeric>(exponent);
    if (n.is_negative()) return fmt::format("(1/{})", power_in_words(base, -n));
    if (n.is_equal(GiNaC::numeric(1))) return b;
    if (n.is_equal(GiNaC::numeric(2))) return fmt::format("sq({})", b);
    if (n.is_equal(GiNaC::numeric(3))) return fmt::format("cube({})", b);
    if (n.is_equal(GiNaC::numeric(1, 2))) return fmt::format("sqrt({})", b);
    if (n.is_equal(GiNaC::numeric(3, 2))) return fmt::format("cube(sqrt({}))", b);
    if (n.is_equal(GiNaC::numeric(5, 2))) return fmt::format("(sq({0})*sqrt({0}))", b);
  }
  return fmt::format("(({})^({}))", b, in_muparser_syntax(exponent));
}

std::string call_in_words(const GiNaC::function& f) {
  std::string name = f.get_name();
  if (name == "csgn" || name == "sign_of_real") name = "sign";
  if (name == "magnitude_of_real") name = "abs";
  std::string arguments;
  for (std::size_t i = 0; i < f.nops(); ++i) arguments += (i ? "," : "") + in_muparser_syntax(f.op(i));
  return fmt::format("{}({})", name, arguments);
}

/// Sort key of terms and factors: their text without parentheses and numerical factor; numbers come first.
std::string order_key(const GiNaC::ex& e, const std::string& text) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return {};
  if (!GiNaC::is_a<GiNaC::mul>(e)) return text;
  const bool has_number = GiNaC::is_a<GiNaC::numeric>(e.op(e.nops() - 1));
  const std::size_t begin = has_number ? text.find(")*") + 2 : 1;
  return text.substr(begin, text.size() - 1 - begin);
}

/// Joins operands in a fixed order. GiNaC orders terms and factors by addresses, which change from run to run; a
/// fixed order gives the same rounding in every run.
std::string joined(const GiNaC::ex& e, const char* separator) {
  std::vector<std::pair<std::string, std::string>> operands;
  for (const GiNaC::ex& operand : e) {
    const std::string text = in_muparser_syntax(operand);
    operands.emplace_back(order_key(operand, text), text);
  }
  std::ranges::sort(operands);
  std::string text = "(";
  for (std::size_t i = 0; i < operands.size(); ++i) text += (i ? separator : "") + operands[i].second;
  return text + ")";
}

}  // namespace

GiNaC::ex formula(const std::string& text, const std::map<std::string, GiNaC::ex>& names) {
  return Parser(text, names).whole();
}

std::string in_muparser_syntax(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return number(GiNaC::ex_to<GiNaC::numeric>(e));
  if (GiNaC::is_a<GiNaC::symbol>(e)) return GiNaC::ex_to<GiNaC::symbol>(e).get_name();
  if (GiNaC::is_a<GiNaC::constant>(e)) return number(GiNaC::ex_to<GiNaC::numeric>(e.evalf()));
  if (GiNaC::is_a<GiNaC::add>(e)) return joined(e, "+");
  if (GiNaC::is_a<GiNaC::mul>(e)) return joined(e, "*");
  if (GiNaC::is_a<GiNaC::power>(e)) return power_in_words(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return call_in_words(GiNaC::ex_to<GiNaC::function>(e));
  throw std::invalid_argument("it cannot be differentiated twice");
}

void check_derivative_size(const GiNaC::ex& f) {
  constexpr double longest = 1e5;
  if (derivative_size(f).second > longest)
    throw std::invalid_argument("its second derivatives are too long; multiply factors out, or use fewer of them");
}

}  // namespace plastron::geometry
