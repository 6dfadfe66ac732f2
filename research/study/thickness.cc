// The same mid-surface, ever thinner. For a linear problem with load l the energy l(U) / 2 grows like 1/e in membrane
// dominated shells and like 1/e^3 in bending dominated ones; r tends to Koiter's rotation.
#include <plastron/computation/solve.hpp>
#include <plastron/geometry/frame.hpp>
#include <research/spectra/field_norms.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

/// One thickness.
struct Sample {
  double factor = 1;
  double thickness = 0;       ///< mean e [m]
  double load_factor = 1;     ///< loads are this multiple of the case's
  energy::Energies energy{};  ///< [J]
  double stiffness = 0;       ///< 2 W / (l(U) / load_factor)^2 [1/J]
  double noise = 0;           ///< relative error of W and l(U), as the energy identity shows it; infinite for no energy
  double koiter = 0;          ///< |r - r_K| / |r| in L2
  double koiter_noise = 0;    ///< what the solver's error makes of it
  double mesh_size = 0;       ///< h [m]
  double layer = 0;           ///< sqrt(e R) at the sharpest curvature; infinite for a plate [m]
  std::int64_t touching = 0;
};

double sharpest_curvature(const assembly::DiscreteShell& discrete) {
  double sharpest = 0;
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    for (int q = 0; q < discrete.shell.tables().points_per_cell(); ++q)
      for (const double kappa : geometry::principal_curvatures(discrete.shell.point(c, q).frame))
        sharpest = std::max(sharpest, std::abs(kappa));
  return algebra::max_over_ranks(sharpest, discrete.space().layout->comm);
}

Sample sample_of(const computation::Result& result, const problem::Problem& problem, double factor,
                 double load_factor) {
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  const algebra::Vector& y = result.solution->nodal.y;
  const ShellSize size = shell_size(discrete);
  const double work = result.summary.load_work / load_factor;
  const double r = std::sqrt(spectra::squared_norms(discrete.shell, y).r);
  const double energy = result.summary.energy.total() + result.summary.tangency_energy;
  const double noise = relative_noise(*result.solution, std::sqrt(2 * energy));
  // An error of so many J^{1/2} can all be shear: k mu e |2 delta|^2 <= its square.
  const shell::Material& material = problem.shell.sections.softest();
  const double shear_noise =
      noise * std::sqrt(2 * energy / (material.shear_correction * material.shear_modulus() * size.thickness));
  return {.factor = factor,
          .thickness = size.thickness,
          .load_factor = load_factor,
          .energy = result.summary.energy,
          .stiffness = 2 * energy / (work * work),
          .noise = noise < too_noisy ? result.certificate.energy_identity : noise,
          .koiter = std::sqrt(spectra::squared_distance_to_koiter(discrete.shell, y)) / r,
          .koiter_noise = noise < too_noisy ? shear_noise / r : std::numeric_limits<double>::infinity(),
          .mesh_size = size.mesh_size,
          .layer = std::sqrt(size.thickness / sharpest_curvature(discrete)),
          .touching = result.summary.touching_nodes};
}

Table thickness_table() {
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

std::vector<double> stiffness_exponents(const std::vector<Sample>& samples) {
  return local_exponents(column(samples, [](const Sample& s) { return s.thickness; }),
                         column(samples, [](const Sample& s) { return s.stiffness; }));
}

/// Why the stiffness has no exponents to be judged; empty if it has.
std::string no_exponents(const std::vector<Sample>& samples, const problem::Problem& problem) {
  constexpr double tolerable = 1e-3;
  if (has_prescribed_motion(problem)) return "the supports prescribe motions, so the stiffness K has no meaning";
  if (!problem.shell.obstacles.empty())
    return "with an obstacle K is a secant stiffness at one load and bound to no power of e";
  if (samples.size() < 2) return "one thickness has no exponent; take more factors";
  const auto e = column(samples, [](const Sample& s) { return s.thickness; });
  const auto exponents = stiffness_exponents(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!(samples[i].noise < too_noisy)) return "the loads do no work beyond rounding";
    if (i == 0) continue;
    const double noise = (samples[i].noise + samples[i - 1].noise) / std::abs(std::log(e[i] / e[i - 1]));
    if (!(noise < tolerable) || std::isnan(exponents[i]))
      return fmt::format("at e = {:.3g} m the energy identity leaves an error of {:.1e} in the exponent", e[i], noise);
  }
  return "";
}

/// e^3 A <= e a(., .) <= e A between any two thicknesses, so the compliance lies between too.
Claim between_one_and_three(const std::vector<Sample>& samples, const std::string& why_not) {
  const std::string statement = "without contact the stiffness falls no slower than e and no faster than e^3";
  if (!why_not.empty()) return not_judged(statement, why_not);
  const auto p = stiffness_exponents(samples);
  const auto [low, high] = std::minmax_element(p.begin() + 1, p.end());
  return judged(statement, fmt::format("exponents from {:.3f} to {:.3f}", *low, *high),
                *low > 1 - 1e-3 && *high < 3 + 1e-3);
}

/// Judged on the thicknesses where the distance is more than noise: it falls, and not only by chance.
Claim koiter_limit(const std::vector<Sample>& samples) {
  constexpr double least_exponent = 0.25;
  const std::string statement = "the rotation r tends to Koiter's r_K = -(d_a u . a_3) a^a as e goes to zero";
  std::vector<double> e, distance;
  double noise = 0;
  for (const Sample& s : samples) {
    noise = std::max(noise, s.koiter_noise);
    if (!(s.koiter > s.koiter_noise)) continue;
    e.push_back(s.thickness);
    distance.push_back(s.koiter);
  }
  if (samples.size() < 2) return not_judged(statement, "one thickness has no limit; take more factors");
  if (distance.size() < 2)
    return not_judged(statement, std::isfinite(noise)
                                     ? fmt::format("|r - r_K| / |r| is rounding, less than {:.0e}", noise)
                                     : "the shell does not rotate beyond rounding");
  const double exponent = fitted_exponent(e, distance);
  return judged(
      statement,
      fmt::format("|r - r_K| / |r| from {:.2e} to {:.2e}, like e^{:.2f}", distance.front(), distance.back(), exponent),
      exponent > least_exponent && distance.back() < distance.front());
}

void warn(const std::vector<Sample>& samples, const problem::Problem& problem, Table& table) {
  const Sample& thinnest = samples.back();
  const double spacing = thinnest.mesh_size / problem.discretisation.degree;
  if (spacing > thinnest.layer)
    table.remarks.push_back(
        fmt::format("warning: at the smallest thickness the nodes are {:.2g} m apart and the layer sqrt(e R) is {:.2g} "
                    "m wide: it is "
                    "not resolved; refine the mesh or end the study earlier",
                    spacing, thinnest.layer));
  if (!problem.shell.obstacles.empty() && spacing > thinnest.thickness / 2)
    table.remarks.push_back(
        fmt::format("warning: at the smallest thickness the nodes are {:.2g} m apart and the layer at the edge of the "
                    "contact zone is "
                    "about e/2 = {:.2g} m wide: energies are good, pressures there are not",
                    spacing, thinnest.thickness / 2));
}

void conclude(const std::vector<Sample>& samples, const problem::Problem& problem, Table& table) {
  const auto e = column(samples, [](const Sample& s) { return s.thickness; });
  const double exponent = fitted_exponent(e, column(samples, [](const Sample& s) { return s.stiffness; }));
  if (samples.size() > 1)
    table.fits = {
        {"stiffness", "e", exponent},
        {"energy", "e", fitted_exponent(e, column(samples, [](const Sample& s) { return s.energy.total(); }))},
        {"|r - r_K| / |r|", "e", fitted_exponent(e, column(samples, [](const Sample& s) { return s.koiter; }))}};
  const std::string why_not = no_exponents(samples, problem);
  if (why_not.empty())
    table.remarks.push_back(fmt::format("exponent {:.2f} on the thinnest shells, {}", exponent, domination(exponent)));
  table.claims = {between_one_and_three(samples, why_not), koiter_limit(samples)};
  if (!problem.shell.obstacles.empty() && samples.front().touching > 0 && samples.back().touching == 0)
    table.remarks.push_back(
        "the thinnest shell no longer touches the obstacle: its load falls faster than its stiffness; for a membrane "
        "dominated shell take --load-exponent 1");
}

io::Plot plot_of(const std::vector<Sample>& samples) {
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

std::vector<double> factors_of(const StudyOptions& options) {
  return options.factors.empty() ? std::vector<double>{1, 0.5, 0.25, 0.125, 0.0625} : options.factors;
}

}  // namespace

std::vector<Variant> thickness_study_variants(const problem::Problem& problem, const StudyOptions& options) {
  return thickness_variants(problem, factors_of(options));
}

Report thickness(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer) {
  const double exponent = options.load_exponent.value_or(problem.shell.obstacles.empty() ? 0 : 3);
  Report report{.table = thickness_table(), .plot = {}};
  report.table.remarks.push_back(exponent == 0 ? std::string("loads are those of the case")
                                               : fmt::format("loads are the case's times factor^{:g}", exponent));
  if (!problem.shell.obstacles.empty())
    report.table.remarks.push_back("mid-surface and obstacle stay; the touching face moves with e/2");
  problem::Problem plain = problem;
  plain.probes.clear();
  std::vector<Sample> samples;
  for (const double factor : factors_of(options)) {
    if (observer.stage) observer.stage(fmt::format("thickness times {:g}", factor));
    const double load_factor = std::pow(factor, exponent);
    const computation::Result result =
        computation::solve(with_loads_scaled(with_thickness_scaled(plain, factor), load_factor), comm, observer.solve);
    report.status = result.status;
    if (result.status != contact::Status::solved) break;
    samples.push_back(sample_of(result, problem, factor, load_factor));
  }
  if (samples.empty()) return report;
  add_rows(samples, problem.discretisation.degree, report.table);
  conclude(samples, problem, report.table);
  warn(samples, problem, report.table);
  report.plot = plot_of(samples);
  return report;
}

}  // namespace plastron::study
