#include <plastron/geometry/chart.hpp>
#include <plastron/geometry/given_function.hpp>
#include <plastron/geometry/quotation.hpp>

#include <vector>

#include "formula.hpp"

namespace plastron::geometry {

namespace {

// Returns the expressions of value, 1, 2, 11, 12, 22.
std::vector<Expression> differentiate(const std::string& text, const Constants& constants) {
  const Expression checked(text, constants);  // for muParser's messages, which contain positions
  if (checked.uses_space())
    throw NotDifferentiable(text, "a chart is a function of x and y, and X, Y, Z are its values");
  const GiNaC::realsymbol x("x"), y("y");
  std::map<std::string, GiNaC::ex> names{{"x", x}, {"y", y}, {"pi", GiNaC::Pi}};
  // Constants stay symbols during differentiation, so that R - R is exactly zero. They may have either sign, so that
  // sqrt(R^2) is not R.
  for (const auto& [name, value] : constants) names[name] = GiNaC::realsymbol(name);
  try {
    const GiNaC::ex f = formula(text, names);
    check_derivative_size(f);
    const GiNaC::ex fx = f.diff(x), fy = f.diff(y);
    std::vector<Expression> all;
    for (const GiNaC::ex& e : {f, fx, fy, fx.diff(x), fx.diff(y), fy.diff(y)})
      all.push_back(Expression::made(in_muparser_syntax(e), constants));
    return all;
  } catch (const ExpressionError&) {
    throw;
  } catch (const std::exception& error) {
    throw NotDifferentiable(text, shortened(error.what(), 200));
  }
}

}  // namespace

Chart::Chart(const std::array<std::string, 3>& components, const Constants& constants) : components_(components) {
  for (int i = 0; i < 3; ++i) {
    given_[i] = given_function(components[i]);
    if (!given_[i])
      derivatives_[i] = differentiate(components[i], constants);
    else if (given_[i]->uses_space)
      throw ExpressionError("a chart is a function of x and y, and X, Y, Z are its values", 0);
  }
}

SurfaceJet Chart::operator()(double x, double y) const {
  SurfaceJet jet;
  evaluate({&x, 1}, {&y, 1}, {&jet, 1});
  return jet;
}

void Chart::evaluate(std::span<const double> x, std::span<const double> y, std::span<SurfaceJet> jets,
                     bool second_derivatives) const {
  std::vector<Place> places(jets.size());
  for (std::size_t p = 0; p < jets.size(); ++p) places[p] = {x[p], y[p]};
  const std::size_t count = second_derivatives ? 6 : 3;
  std::vector<double> values(count * jets.size());
  for (int i = 0; i < 3; ++i) {
    if (given_[i])
      given_[i]->evaluate(places, 0, static_cast<int>(count), values);
    else
      for (std::size_t k = 0; k < count; ++k)
        derivatives_[i][k].evaluate(places, std::span(values).subspan(k * jets.size(), jets.size()));
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t p = 0; p < jets.size(); ++p)
        (k == 0 ? jets[p].value : k < 3 ? jets[p].d[k - 1] : jets[p].dd[k - 3])[i] = values[k * jets.size() + p];
  }
}

}  // namespace plastron::geometry
