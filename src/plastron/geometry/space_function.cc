#include <plastron/geometry/given_function.hpp>
#include <plastron/geometry/quotation.hpp>
#include <plastron/geometry/space_function.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "formula.hpp"
#include "parser.hpp"

namespace plastron::geometry {

namespace {

constexpr std::array<const char*, 3> coordinates{"X", "Y", "Z"};

void check_constants(const Constants& constants) {
  for (const auto& [name, value] : constants)
    for (const char* coordinate : coordinates)
      if (name == coordinate)
        throw ExpressionError(
            fmt::format("{} is a coordinate here, and cannot be the constant of that name, too", name), 0);
}

/// Returns f, its three first and its six second derivatives: 11, 12, 13, 22, 23, 33.
std::array<GiNaC::ex, 10> derivatives(const std::string& text, const Constants& constants) {
  std::array<GiNaC::realsymbol, 3> x;
  std::map<std::string, GiNaC::ex> names{{"pi", GiNaC::Pi}};
  for (std::size_t i = 0; i < 3; ++i) names[coordinates[i]] = x[i] = GiNaC::realsymbol(coordinates[i]);
  for (const auto& [name, value] : constants) names[name] = GiNaC::realsymbol(name);
  std::array<GiNaC::ex, 10> all;
  all[0] = formula(text, names);
  check_derivative_size(all[0]);
  std::size_t second = 4;
  for (std::size_t i = 0; i < 3; ++i) {
    all[1 + i] = all[0].diff(x[i]);
    for (std::size_t j = i; j < 3; ++j) all[second++] = all[1 + i].diff(x[j]);
  }
  return all;
}

/// Returns the value and derivatives from their list, in the order of derivatives().
SpaceJet jet_of(const double* f) {
  SpaceJet jet{.value = f[0], .gradient = {f[1], f[2], f[3]}};
  jet.hessian << f[4], f[5], f[6], f[5], f[7], f[8], f[6], f[8], f[9];
  return jet;
}

constexpr std::size_t jet_size = 10;

/// Returns the derivatives 0, ..., count - 1 of a given function, those of a point together.
std::vector<double> given_values(const GivenFunction& function, std::span<const Vector3d> X, std::size_t count) {
  constexpr std::size_t most_points = 4096;  // bounds the memory of a call
  std::vector<double> all, values;
  all.reserve(count * X.size());
  for (std::size_t first = 0; first < X.size(); first += most_points) {
    std::vector<Place> places;
    for (const Vector3d& x : X.subspan(first, std::min(most_points, X.size() - first)))
      places.push_back({.X = x[0], .Y = x[1], .Z = x[2]});
    values.resize(count * places.size());
    function.evaluate(places, 0, static_cast<int>(count), values);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t k = 0; k < count; ++k) all.push_back(values[k * places.size() + i]);
  }
  return all;
}

}  // namespace

// muParser keeps the addresses of its variables. `derivatives` evaluates all ten numbers at once.
struct SpaceFunction::Program {
  mu::Parser value, derivatives;
  Vector3d at = Vector3d::Zero();
  std::shared_ptr<const GivenFunction> given{};  // in the place of the parsers

  mu::Parser parser(const std::string& text, const Constants& constants) {
    mu::Parser made = parser_with(constants);
    for (int i = 0; i < 3; ++i) made.DefineVar(coordinates[static_cast<std::size_t>(i)], &at[i]);
    made.SetExpr(text);
    return made;
  }
};

SpaceFunction::SpaceFunction(std::string text, const Constants& constants) : text_(std::move(text)) {
  check_size(text_);
  check_constants(constants);
  auto program = std::make_shared<Program>();
  if (auto given = given_function(text_)) {
    if (given->uses_parameters)
      throw ExpressionError("a function of x and y is no function of space: it takes X, Y, Z", 0);
    program->given = std::move(given);
    depends_on_ = program->given->depends_on;
    program_ = std::move(program);
    return;
  }
  try {
    program->value = program->parser(text_, constants);
    program->value.Eval();
    if (program->value.GetNumResults() != 1)
      throw ExpressionError(fmt::format("\"{}\" has more than one value", shortened(text_)), 0);
  } catch (const mu::ParserError& error) {
    rethrow(error, text_);
  }
  try {
    std::string list;
    const auto all = derivatives(text_, constants);
    for (const GiNaC::ex& f : all) list += (list.empty() ? "" : ",") + in_muparser_syntax(f);
    for (std::size_t i = 0; i < 3; ++i) depends_on_[i] = !all[1 + i].is_zero();
    program->derivatives = program->parser(list, constants);
    program->derivatives.Eval();
  } catch (const std::exception& error) {
    throw NotDifferentiable(text_, shortened(error.what(), 200));
  } catch (const mu::ParserError& error) {
    throw NotDifferentiable(text_, shortened(error.GetMsg(), 200));
  }
  program_ = std::move(program);
}

double SpaceFunction::value(const Vector3d& X) const {
  if (program_->given) return values({&X, 1})[0];
  program_->at = X;
  return program_->value.Eval();
}

SpaceJet SpaceFunction::operator()(const Vector3d& X) const {
  if (program_->given) return jets({&X, 1})[0];
  program_->at = X;
  int count = 0;
  return jet_of(program_->derivatives.Eval(count));
}

std::vector<double> SpaceFunction::values(std::span<const Vector3d> X) const {
  if (program_->given) return given_values(*program_->given, X, 1);
  std::vector<double> all;
  all.reserve(X.size());
  for (const Vector3d& x : X) all.push_back(value(x));
  return all;
}

std::vector<SpaceJet> SpaceFunction::jets(std::span<const Vector3d> X) const {
  std::vector<SpaceJet> all;
  all.reserve(X.size());
  if (program_->given) {
    const std::vector<double> numbers = given_values(*program_->given, X, jet_size);
    for (std::size_t i = 0; i < X.size(); ++i) all.push_back(jet_of(numbers.data() + jet_size * i));
  } else {
    for (const Vector3d& x : X) all.push_back((*this)(x));
  }
  return all;
}

}  // namespace plastron::geometry
