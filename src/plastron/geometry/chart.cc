#include <plastron/geometry/chart.hpp>
#include <plastron/geometry/given_function.hpp>
#include <plastron/geometry/quotation.hpp>

#include <vector>

#include "formula.hpp"

namespace plastron::geometry {

namespace {

/// The names of expressions as symbols. Constants stay symbols during differentiation, so that R - R is exactly zero. They
/// may have either sign, so that sqrt(R^2) is not R.
struct Symbols {
  explicit Symbols(const Constants& named) : constants(named) {
    names = {{"x", x}, {"y", y}, {"pi", GiNaC::Pi}};
    for (const auto& [name, value] : constants) names[name] = GiNaC::realsymbol(name);
  }
  const Constants& constants;
  GiNaC::realsymbol x{"x"}, y{"y"};
  std::map<std::string, GiNaC::ex> names{};
};

/// Calls `work`. Errors of GiNaC become NotDifferentiable of the text.
template <class Work>
auto differentiating(const std::string& text, const Work& work) {
  try {
    return work();
  } catch (const ExpressionError&) {
    throw;
  } catch (const std::exception& error) {
    throw NotDifferentiable(text, shortened(error.what(), 200));
  }
}

GiNaC::ex checked_formula(const std::string& text, const Symbols& symbols) {
  const Expression checked(text, symbols.constants);  // for muParser's messages, which contain positions
  if (checked.uses_space())
    throw NotDifferentiable(text, "a chart is a function of x and y, and X, Y, Z are its values");
  return differentiating(text, [&] { return formula(text, symbols.names); });
}

/// Returns the expressions of value, 1, 2, 11, 12, 22.
std::vector<Expression> differentiate(const std::string& text, const GiNaC::ex& f, const Symbols& symbols) {
  return differentiating(text, [&] {
    check_derivative_size(f);
    const GiNaC::ex fx = f.diff(symbols.x), fy = f.diff(symbols.y);
    std::vector<Expression> all;
    for (const GiNaC::ex& e : {f, fx, fy, fx.diff(symbols.x), fx.diff(symbols.y), fy.diff(symbols.y)})
      all.push_back(Expression::made(in_muparser_syntax(e), symbols.constants));
    return all;
  });
}

using Formulas = std::array<GiNaC::ex, 3>;

Formulas unit_normal_of(const Formulas& phi, const Symbols& symbols) {
  Formulas n;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = phi[j].diff(symbols.x) * phi[k].diff(symbols.y) - phi[k].diff(symbols.x) * phi[j].diff(symbols.y);
  }
  const GiNaC::ex length = GiNaC::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (GiNaC::ex& component : n) component = component / length;
  return n;
}

/// Returns the sum of the displacements.
Formulas sum_of(const std::vector<ChartDisplacement>& displacements, const Formulas& phi, const Symbols& symbols) {
  Formulas sum;
  for (const ChartDisplacement& displacement : displacements) {
    const GiNaC::ex along_normal = checked_formula(displacement.normal, symbols);
    const Formulas normal = along_normal.is_zero() ? Formulas{} : unit_normal_of(phi, symbols);
    for (std::size_t i = 0; i < 3; ++i)
      sum[i] += checked_formula(displacement.cartesian[i], symbols) + along_normal * normal[i];
  }
  return sum;
}

}  // namespace

Chart::Chart(const std::array<std::string, 3>& components, const Constants& constants,
             const std::vector<ChartDisplacement>& displacements)
    : components_(components) {
  const Symbols symbols(constants);
  Formulas phi;
  for (std::size_t i = 0; i < 3; ++i) {
    given_[i] = given_function(components[i]);
    if (!given_[i]) phi[i] = checked_formula(components[i], symbols);
    if (given_[i] && given_[i]->uses_space)
      throw ExpressionError("a chart is a function of x and y, and X, Y, Z are its values", 0);
    if (given_[i] && !displacements.empty())
      throw ExpressionError("a chart that is a function of the program has no imperfections: add them in the function",
                            0);
  }
  const Formulas displacement = sum_of(displacements, phi, symbols);
  for (std::size_t i = 0; i < 3; ++i)
    if (!given_[i]) derivatives_[i] = differentiate(components[i], phi[i] + displacement[i], symbols);
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
