// The constants of coercivity (alpha) and of the inf-sup conditions (beta_b, beta_c) over mesh size and thickness
// (docs/research/stability.md).
#include <plastron/meshing/sequence.hpp>
#include <plastron/meshing/sizes.hpp>
#include <research/spectra/spectra.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace plastron::study {

namespace {

// ---- computation -------------------------------------------------------------------------------------------------------

/// One thickness on one mesh. NaN where a constant is not defined.
struct Sample {
  double factor = 1;
  double thickness = 0;  ///< mean e [m]
  int level = 0;
  double mesh_size = 0;  ///< h, of a cell [m]
  std::int64_t nodes = 0;
  double alpha = no_value, relative_alpha = no_value;       ///< [J]; relative: alpha / (E e^3)
  double b = no_value, c_dual = no_value, c_l2 = no_value;  ///< inf-sup constants
};
using Samples = std::vector<Sample>;
using Value = double Sample::*;

assembly::ShellDescription without_loads(const problem::Problem& problem, bool with_gap) {
  assembly::ShellDescription shell = problem.shell;
  shell.loads = {};
  if (!with_gap) shell.obstacles = {};
  return shell;
}

/// Computes the samples. All constants are extreme eigenvalues: no load and no solution enters.
class Stability {
 public:
  Stability(const problem::Problem& problem, const std::vector<double>& factors, double length, MPI_Comm comm,
            const StudyObserver& observer)
      : problem_(problem), factors_(factors), length_(length), comm_(comm), observer_(observer) {}

  /// From thick to thin, for each thickness from coarse to fine. Empty if interrupted.
  Samples samples() {
    const int finest = problem_.discretisation.refinements;
    fem::MeshSequence meshes = meshing::mesh_sequence(problem_, comm_);
    surface_ = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem_.charts);
    Samples all;
    for (int level = 0; level <= finest; ++level) {
      if (level > 0) meshes.refine({});
      if (level + 3 < finest) continue;  // h, h/2, h/4, h/8
      const std::optional<double> b = inf_sup_of_b(meshes.space(), level);
      for (const double factor : factors_) {
        if (computation::wants_to_stop(observer_.solve, comm_)) return {};
        all.push_back(measure(meshes.space(), level, factor));
        all.back().b = b.value_or(no_value);
      }
    }
    std::ranges::stable_sort(all, std::ranges::greater{}, &Sample::factor);
    return all;
  }

 private:
  using SpacePointer = std::shared_ptr<const fem::Space>;

  void tell(int level, const std::string& what) const {
    if (observer_.stage) observer_.stage(fmt::format("mesh {}: {}", level, what));
  }

  /// Neither b nor the norms contain the thickness or the formulation: one value a mesh.
  std::optional<double> inf_sup_of_b(const SpacePointer& space, int level) {
    tell(level, "inf-sup constant of b");
    const problem::Problem mixed = in_formulation(problem_, element::Formulation::mixed);
    return spectra::tangency_inf_sup(*assembly::discretise(space, surface_, without_loads(mixed, false)), length_);
  }

  Sample measure(const SpacePointer& space, int level, double factor) {
    const problem::Problem thin = with_thickness_scaled(problem_, factor);
    tell(level, fmt::format("coercivity, thickness times {:g}", factor));
    const auto discrete = assembly::discretise(space, surface_, without_loads(thin, false));
    const ShellSize size = shell_size(*discrete);
    Sample sample{.factor = factor,
                  .thickness = size.thickness,
                  .level = level,
                  .mesh_size = size.mesh_size,
                  .nodes = space->layout->global_size};
    sample.alpha = spectra::softest_modes(*discrete, 1, length_).at(0).stiffness;
    sample.relative_alpha = sample.alpha / (problem_.shell.sections.softest().young() * std::pow(sample.thickness, 3));
    if (problem_.shell.obstacles.empty()) return sample;
    tell(level, fmt::format("inf-sup constant of c, thickness times {:g}", factor));
    measure_contact(space, thin, sample);
    return sample;
  }

  /// Takes the least constant over the obstacles, each by itself. Gaps of several obstacles may share a coordinate, and then
  /// their multipliers never act together.
  void measure_contact(const SpacePointer& space, const problem::Problem& thin, Sample& sample) {
    const auto least = [](double& known, double value) { known = std::isnan(known) ? value : std::min(known, value); };
    const assembly::ShellDescription all = without_loads(thin, true);
    for (const obstacle::Obstacle& obstacle : all.obstacles.all) {
      assembly::ShellDescription alone = all;
      alone.obstacles.all = {obstacle};
      const auto touching = assembly::discretise(space, surface_, alone);
      if (const auto c = spectra::contact_inf_sup(*touching, length_)) {
        least(sample.c_dual, c->dual);
        least(sample.c_l2, c->l2);
      }
    }
  }

  const problem::Problem& problem_;
  const std::vector<double>& factors_;
  double length_;  ///< L of the norms [m]
  MPI_Comm comm_;
  const StudyObserver& observer_;
  std::shared_ptr<const fem::Surface> surface_{};
};

// ---- the table and its claims ------------------------------------------------------------------------------------------

Table stability_table() {
  return {.name = "stability",
          .title = "Do the constants of coercivity and of the inf-sup conditions hold as h and e go to zero?",
          .columns = {{"factor", "", "1"},
                      {"thickness", "e", "m"},
                      {"level", "", "1"},
                      {"mesh", "h", "m"},
                      {"nodes", "", "1"},
                      {"coercivity", "alpha", "J"},
                      {"relative", "alpha / (E e^3)", "1"},
                      {"inf-sup b", "beta_b", "1"},
                      {"inf-sup c", "beta_c", "1"},
                      {"inf-sup c, L2", "beta_c,0", "1"},
                      {"scaled", "beta_c,0 L / h", "1"}}};
}

void add_rows(const Samples& samples, double length, Table& table) {
  for (const Sample& s : samples)
    table.rows.push_back({s.factor, s.thickness, static_cast<std::int64_t>(s.level), s.mesh_size, s.nodes, s.alpha,
                          s.relative_alpha, s.b, s.c_dual, s.c_l2, s.c_l2 * length / s.mesh_size});
}

template <class Wanted>
Samples those(const Samples& samples, const Wanted& wanted) {
  Samples some;
  std::ranges::copy_if(samples, std::back_inserter(some), wanted);
  return some;
}
Samples of_factor(const Samples& samples, double factor) {
  return those(samples, [&](const Sample& s) { return s.factor == factor; });
}
Samples of_level(const Samples& samples, int level) {
  return those(samples, [&](const Sample& s) { return s.level == level; });
}
Samples with(const Samples& samples, Value value) {
  return those(samples, [&](const Sample& s) { return std::isfinite(s.*value); });
}

/// Names the parameters that differ among the samples; empty for one sample.
std::string varied(const Samples& samples) {
  const auto differs = [&](const auto& member) {
    return std::ranges::any_of(samples, [&](const Sample& s) { return s.*member != samples.front().*member; });
  };
  const bool mesh = differs(&Sample::level), thickness = differs(&Sample::factor);
  if (mesh && thickness) return "the mesh size or the thickness";
  return mesh ? "the mesh size" : thickness ? "the thickness" : "";
}

/// Nowhere less than `share` of `reference`. The first sample is the coarsest mesh and the thickest shell.
Claim does_not_degrade(const Samples& samples, Value value, const std::string& symbol, double share, double reference) {
  const std::string what = varied(samples);
  if (what.empty())
    return not_judged(symbol + " does not go to zero with the mesh size or the thickness",
                      "one mesh and one thickness have nothing to be compared with; take more refinements or factors");
  const auto [low, high] = std::ranges::minmax(column(samples, value));
  return judged(fmt::format("{} does not go to zero with {}", symbol, what),
                fmt::format("from {:.4g} to {:.4g}, {:.4g} on the coarsest mesh and the thickest shell", low, high,
                            samples.front().*value),
                low > share * reference);
}

void examine_coercivity(const Samples& samples, const problem::Problem& problem, Table& table) {
  const std::string symbol = "alpha / (E e^3)";
  if (std::ranges::all_of(samples, [](const Sample& s) { return s.alpha <= 0; })) {
    table.claims.push_back(not_judged(symbol + " does not go to zero with the mesh size or the thickness",
                                      "alpha is zero: the supports leave a rigid motion free, so a(., .) is not "
                                      "coercive; the obstacle alone can hold "
                                      "the shell"));
    return;
  }
  // Short waves of s across their direction cost mu e^3 / 12 on any shell: no alpha is larger in the limit of fine meshes.
  const shell::Material& material = problem.shell.sections.softest();
  const double of_short_waves = material.shear_modulus() / (12 * material.young());
  table.claims.push_back(does_not_degrade(samples, &Sample::relative_alpha, symbol, 0.5,
                                          std::min(samples.front().relative_alpha, of_short_waves)));
  const auto finest = of_level(samples, samples.back().level);
  if (finest.size() > 1)
    table.fits.push_back(
        {"alpha", "e", fitted_exponent(column(finest, &Sample::thickness), column(finest, &Sample::alpha))});
}

/// b and its norms contain neither the thickness nor the formulation: one thickness says all.
void examine_tangency(const Samples& samples, Table& table) {
  const auto measured = with(of_factor(samples, samples.front().factor), &Sample::b);
  if (measured.empty()) {
    table.claims.push_back(not_judged("beta_b does not go to zero with the mesh size",
                                      "no support holds a rotation, so b, which sees gradients only, has no inf-sup "
                                      "constant"));
    return;
  }
  table.claims.push_back(does_not_degrade(measured, &Sample::b, "beta_b", 0.9, measured.front().b));
  table.remarks.push_back(
      "b and its norms contain neither the thickness nor the formulation: beta_b is computed once a mesh");
}

void examine_contact(const Samples& samples, bool has_obstacle, Table& table) {
  const auto measured = with(samples, &Sample::c_dual);
  const std::string symbol = "beta_c, in the dual norm of H^1,";
  if (measured.empty()) {
    table.claims.push_back(
        not_judged(symbol + " does not go to zero with the mesh size or the thickness",
                   has_obstacle ? "no node can move against the obstacle" : "without obstacle there is no c"));
    return;
  }
  table.claims.push_back(does_not_degrade(measured, &Sample::c_dual, symbol, 0.9, measured.front().c_dual));
  const auto thick = of_factor(measured, measured.front().factor);
  const double exponent = fitted_exponent(column(thick, &Sample::mesh_size), column(thick, &Sample::c_l2));
  const std::string statement = "in L2 the constant of c falls like h: no inf-sup condition holds there";
  if (std::isnan(exponent)) {
    table.claims.push_back(not_judged(statement, "one mesh has no exponent; take more refinements"));
    return;
  }
  table.fits.push_back({"beta_c,0", "h", exponent});
  table.claims.push_back(judged(statement, fmt::format("beta_c,0 ~ h^{:.2f}", exponent), std::abs(exponent - 1) < 0.3));
}

io::Plot plot_of(const Samples& samples) {
  io::Plot plot{.title = "Constants of coercivity and of the inf-sup conditions",
                .x = {"mesh size h [m]", true},
                .y = {"constant", true},
                .slopes = {{1, "slope 1"}}};
  const auto add = [&](const std::string& label, const Samples& some, Value value, bool dashed = false) {
    const auto measured = with(some, value);
    if (!measured.empty())
      plot.series.push_back({label, column(measured, &Sample::mesh_size), column(measured, value), dashed});
  };
  const auto thick = of_factor(samples, samples.front().factor), thin = of_factor(samples, samples.back().factor);
  add("beta_b", thick, &Sample::b);
  add("beta_c, thickest", thick, &Sample::c_dual);
  add("beta_c, thinnest", thin, &Sample::c_dual, true);
  add("beta_c in L2", thick, &Sample::c_l2);
  add("alpha / (E e^3), thickest", thick, &Sample::relative_alpha);
  add("alpha / (E e^3), thinnest", thin, &Sample::relative_alpha, true);
  return plot;
}

std::vector<double> factors_of(const StudyOptions& options) {
  return options.factors.empty() ? std::vector<double>{1, 0.1, 0.01} : options.factors;
}

}  // namespace

std::vector<Variant> stability_variants(const problem::Problem& problem, const StudyOptions& options) {
  return thickness_variants(problem, factors_of(options));
}

Report stability(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer) {
  const double length = meshing::extent(problem);
  const std::vector<double> factors = factors_of(options);
  const Samples samples = Stability(problem, factors, length, comm, observer).samples();
  Report report{.table = stability_table(), .plot = {}};
  if (samples.empty()) return report.status = contact::Status::interrupted, report;
  add_rows(samples, length, report.table);
  report.table.remarks.push_back(fmt::format(
      "the norms take the shell's own length L = {:.4g} m, half the diagonal of the box around it, as unit of length",
      length));
  examine_coercivity(samples, problem, report.table);
  examine_tangency(samples, report.table);
  examine_contact(samples, !problem.shell.obstacles.empty(), report.table);
  report.plot = plot_of(samples);
  return report;
}

}  // namespace plastron::study
