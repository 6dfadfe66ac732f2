#include "formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
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

}  // namespace

GiNaC::ex formula(const std::string& text, const std::map<std::string, GiNaC::ex>& names) {
  return Parser(text, names).whole();
}

}  // namespace plastron::geometry
