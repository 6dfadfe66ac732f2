// The same mid-surface, ever thinner. For a linear problem with load l the energy l(U) / 2 grows like 1/e in membrane
// dominated shells and like 1/e^3 in bending dominated ones; r tends to Koiter's rotation.
#include <plastron/study/thickness.hpp>

#include <plastron/assembly/field_norms.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/study/exponents.hpp>
#include <plastron/study/solve.hpp>
#include <plastron/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

/// One thickness.
struct Sample {
  double factor = 1;
  double thickness = 0;         ///< mean e [m]
  double load_factor = 1;       ///< loads are this multiple of the case's
  assembly::Energies energy{};  ///< [J]
  double stiffness = 0;         ///< 2 W / (l(U) / load_factor)^2 [1/J]
  double koiter = 0;            ///< |r - r_K| / |r| in L2
  double mesh_size = 0;         ///< h [m]
  double layer = 0;             ///< sqrt(e R) at the sharpest curvature; infinite for a plate [m]
  std::int64_t touching = 0;
};

/// Sums over the mid-surface.
struct Measures {
  double area = 0, mean_thickness = 0, sharpest_curvature = 0;
};

Measures measure(const assembly::DiscreteShell& discrete) {
  Measures m;
  const MPI_Comm comm = discrete.space().layout->comm;
  double volume = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    m.area += discrete.points[i].weight;
    volume += discrete.points[i].weight * discrete.points[i].thickness;
  }
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    for (int q = 0; q < discrete.shell.tables().points_per_cell(); ++q)
      for (const double kappa : geometry::principal_curvatures(discrete.shell.point(c, q).frame))
        m.sharpest_curvature = std::max(m.sharpest_curvature, std::abs(kappa));
  m.area = algebra::sum_over_ranks(m.area, comm);
  m.mean_thickness = algebra::sum_over_ranks(volume, comm) / m.area;
  m.sharpest_curvature = algebra::max_over_ranks(m.sharpest_curvature, comm);
  return m;
}

Sample sample_of(const Result& result, double factor, double load_factor) {
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  const algebra::Vector& y = result.solution->nodal.y;
  const Measures m = measure(discrete);
  const double work = result.summary.load_work / load_factor;
  const double r = std::sqrt(assembly::squared_norms(discrete.shell, y).r);
  return {.factor = factor,
          .thickness = m.mean_thickness,
          .load_factor = load_factor,
          .energy = result.summary.energy,
          .stiffness = 2 * result.summary.energy.total() / (work * work),
          .koiter = std::sqrt(assembly::squared_distance_to_koiter(discrete.shell, y)) / r,
          .mesh_size = std::sqrt(m.area / static_cast<double>(discrete.space().global_cells)),
          .layer = std::sqrt(m.mean_thickness / m.sharpest_curvature),
          .touching = result.summary.touching_nodes};
}

template <class Take>
std::vector<double> column(const std::vector<Sample>& samples, const Take& take) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& s : samples) values.push_back(take(s));
  return values;
}

Table empty_table() {
  return {.name = "thickness",
          .title = "What happens as the thickness goes to zero?",
          .columns = {{"factor", "", "1"},
                      {"thickness", "e", "m"},
                      {"load factor", "", "1"},
                      {"energy", "W", "J"},
                      {"membrane", "", "%"},
                      {"bending", "", "%"},
                      {"shear", "", "%"},
                      {"stiffness", "K", "1/J"},
                      {"exponent", "", "1"},
                      {"Koiter", "|r - r_K| / |r|", "1"},
                      {"mesh", "h / e", "1"},
                      {"layer", "h / (k sqrt(e R))", "1"},
                      {"contact nodes", "", "1"}}};
}

void add_rows(const std::vector<Sample>& samples, int degree, Table& table) {
  const auto exponents = local_exponents(column(samples, [](const Sample& s) { return s.thickness; }),
                                         column(samples, [](const Sample& s) { return s.stiffness; }));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    const double total = s.energy.total(), percent = 100 / total;
    table.rows.push_back({s.factor, s.thickness, s.load_factor, total, percent * s.energy.membrane,
                          percent * s.energy.bending, percent * s.energy.shear, s.stiffness, exponents[i], s.koiter,
                          s.mesh_size / s.thickness, s.mesh_size / (degree * s.layer), s.touching});
  }
}

std::string domination(double exponent) {
  constexpr double near = 0.2;
  if (exponent < 1 + near) return "membrane dominated: the stiffness tends to a multiple of e";
  if (exponent > 3 - near) return "bending dominated: the stiffness tends to a multiple of e^3";
  return "mixed or not yet at its limit: the exponent lies between those of membrane (1) and bending (3)";
}

/// e^3 A <= e a(., .) <= e A between any two thicknesses, so the compliance lies between too.
Claim between_one_and_three(const std::vector<Sample>& samples) {
  const auto p = local_exponents(column(samples, [](const Sample& s) { return s.thickness; }),
                                 column(samples, [](const Sample& s) { return s.stiffness; }));
  const auto [low, high] = std::minmax_element(p.begin() + 1, p.end());
  return {.statement = "without contact the stiffness falls no slower than e and no faster than e^3",
          .measured = fmt::format("exponents from {:.3f} to {:.3f}", *low, *high),
          .holds = *low > 1 - 1e-3 && *high < 3 + 1e-3};
}

Claim koiter_limit(const std::vector<Sample>& samples) {
  const auto distance = column(samples, [](const Sample& s) { return s.koiter; });
  const double exponent = fitted_exponent(column(samples, [](const Sample& s) { return s.thickness; }), distance);
  return {.statement = "the rotation r tends to Koiter's r_K = -(d_a u . a_3) a^a as e goes to zero",
          .measured = fmt::format("|r - r_K| / |r| from {:.2e} to {:.2e}, like e^{:.2f}", distance.front(),
                                  distance.back(), exponent),
          .holds = exponent > 0 && distance.back() < distance.front()};
}

void warn(const std::vector<Sample>& samples, const Problem& problem, Table& table) {
  const Sample& thinnest = samples.back();
  const double spacing = thinnest.mesh_size / problem.discretisation.degree;
  if (spacing > thinnest.layer)
    table.remarks.push_back(
        fmt::format("warning: at the smallest thickness the nodes are {:.2g} m apart and the layer sqrt(e R) is {:.2g} "
                    "m wide: it is "
                    "not resolved; refine the mesh or end the study earlier",
                    spacing, thinnest.layer));
  if (problem.obstacle && spacing > thinnest.thickness / 2)
    table.remarks.push_back(
        fmt::format("warning: at the smallest thickness the nodes are {:.2g} m apart and the layer at the edge of the "
                    "contact zone is "
                    "about e/2 = {:.2g} m wide: energies are good, pressures there are not",
                    spacing, thinnest.thickness / 2));
}

void conclude(const std::vector<Sample>& samples, const Problem& problem, Table& table) {
  if (samples.size() < 2) return;
  const auto e = column(samples, [](const Sample& s) { return s.thickness; });
  const double exponent = fitted_exponent(e, column(samples, [](const Sample& s) { return s.stiffness; }));
  table.fits = {
      {"stiffness", "e", exponent},
      {"energy", "e", fitted_exponent(e, column(samples, [](const Sample& s) { return s.energy.total(); }))},
      {"|r - r_K| / |r|", "e", fitted_exponent(e, column(samples, [](const Sample& s) { return s.koiter; }))}};
  if (has_prescribed_motion(problem)) {
    table.remarks.push_back("the supports prescribe motions, so the stiffness K has no meaning and is not judged");
  } else if (problem.obstacle) {
    table.remarks.push_back("with an obstacle K is a secant stiffness at one load and bound to no power of e");
  } else {
    table.remarks.push_back(fmt::format("exponent {:.2f} on the thinnest shells, {}", exponent, domination(exponent)));
    table.claims.push_back(between_one_and_three(samples));
  }
  table.claims.push_back(koiter_limit(samples));
  if (problem.obstacle && samples.front().touching > 0 && samples.back().touching == 0)
    table.remarks.push_back(
        "the thinnest shell no longer touches the obstacle: its load falls faster than its stiffness; for a membrane "
        "dominated shell take --load-exponent 1");
}

Plot plot_of(const std::vector<Sample>& samples) {
  const auto e = column(samples, [](const Sample& s) { return s.thickness; });
  const double thick = samples.front().stiffness;
  return {.title = "The limit of zero thickness",
          .x = {"thickness e [m]", true},
          .y = {"relative to the thickest, or to |r|", true},
          .series = {{"stiffness K / K of the thickest", e,
                      column(samples, [&](const Sample& s) { return s.stiffness / thick; })},
                     {"|r - r_K| / |r|", e, column(samples, [](const Sample& s) { return s.koiter; })},
                     {"bending share of the energy", e,
                      column(samples, [](const Sample& s) { return s.energy.bending / s.energy.total(); }), true}},
          .slopes = {{1, "slope 1: membrane"}, {3, "slope 3: bending"}}};
}

}  // namespace

Report thickness(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer) {
  const double exponent = options.load_exponent.value_or(problem.obstacle ? 3 : 0);
  Report report{.table = empty_table(), .plot = {}};
  report.table.remarks.push_back(exponent == 0 ? std::string("loads are those of the case")
                                               : fmt::format("loads are the case's times factor^{:g}", exponent));
  if (problem.obstacle)
    report.table.remarks.push_back("mid-surface and obstacle stay; the touching face moves with e/2");
  Problem plain = problem;
  plain.probes.clear();
  std::vector<Sample> samples;
  const std::vector<double> halvings{1, 0.5, 0.25, 0.125, 0.0625};
  for (const double factor : options.factors.empty() ? halvings : options.factors) {
    if (observer.stage) observer.stage(fmt::format("thickness times {:g}", factor));
    const double load_factor = std::pow(factor, exponent);
    const Result result =
        solve(with_loads_scaled(with_thickness_scaled(plain, factor), load_factor), comm, observer.solve);
    report.status = result.status;
    if (result.status != contact::Status::solved) break;
    samples.push_back(sample_of(result, factor, load_factor));
  }
  if (samples.empty()) return report;
  add_rows(samples, problem.discretisation.degree, report.table);
  conclude(samples, problem, report.table);
  warn(samples, problem, report.table);
  report.plot = plot_of(samples);
  return report;
}

}  // namespace plastron::study
