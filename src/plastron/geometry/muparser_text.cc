#include "muparser_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "derivative_size.hpp"

namespace plastron::geometry {

namespace {

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
