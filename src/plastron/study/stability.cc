// The constants of coercivity (alpha) and of the inf-sup conditions (beta_b, beta_c) on a sequence of meshes and for a
// sequence of thicknesses. All are extreme eigenvalues; no load and no solution enters.
#include <plastron/study/stability.hpp>

#include <plastron/assembly/inf_sup.hpp>
#include <plastron/assembly/soft_modes.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/study/exponents.hpp>
#include <plastron/study/gap.hpp>
#include <plastron/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// One thickness on one mesh.
struct Sample {
  double factor = 1;
  double thickness = 0;  ///< mean e [m]
  int level = 0;
  double mesh_size = 0;  ///< h, of a cell [m]
  std::int64_t nodes = 0;
  double alpha = no_value, relative_alpha = no_value;       ///< relative: alpha / (E e^3)
  double b = no_value, c_dual = no_value, c_l2 = no_value;  ///< inf-sup constants
};

assembly::ShellDescription describe(const Problem& problem, bool with_gap) {
  return {.thickness = problem.thickness,
          .material = problem.material,
          .tying = problem.discretisation.tying,
          .tangency = problem.discretisation.tangency,
          .supports = problem.supports,
          .gap = with_gap ? gap_function(problem) : assembly::GapFunction{}};
}

Problem in_formulation(Problem problem, assembly::Formulation formulation) {
  problem.discretisation.tangency.formulation = formulation;
  return problem;
}

class Stability {
 public:
  Stability(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer)
      : problem_(problem),
        factors_(options.factors.empty() ? std::vector<double>{1, 0.1, 0.01} : options.factors),
        comm_(comm),
        observer_(observer) {}

  /// Empty if interrupted.
  std::vector<Sample> samples() {
    const int degree = problem_.discretisation.degree, finest = problem_.discretisation.refinements;
    fem::MeshSequence meshes(fem::coarse_mesh(problem_.domain), degree, comm_);
    surface_ = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem_.charts);
    std::vector<Sample> all;
    for (int level = 0; level <= finest; ++level) {
      if (level > 0) meshes.refine({});
      if (level + 3 < finest) continue;  // h, h/2, h/4, h/8
      const std::optional<double> b = inf_sup_of_b(meshes.space(), level);
      for (const double factor : factors_) {
        if (wants_to_stop(observer_.solve, comm_)) return {};
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
    const Problem mixed = in_formulation(problem_, assembly::Formulation::mixed);
    return assembly::tangency_inf_sup(*assembly::discretise(space, surface_, describe(mixed, false)));
  }

  Sample measure(const SpacePointer& space, int level, double factor) {
    const Problem thin = with_thickness_scaled(problem_, factor);
    tell(level, fmt::format("coercivity, thickness times {:g}", factor));
    const auto discrete = assembly::discretise(space, surface_, describe(thin, false));
    Sample sample{.factor = factor, .level = level, .nodes = space->layout->global_size};
    measure_size(*discrete, sample);
    sample.alpha = assembly::softest_modes(*discrete, 1).at(0).stiffness;
    sample.relative_alpha = sample.alpha / (problem_.material.young() * std::pow(sample.thickness, 3));
    if (!problem_.obstacle) return sample;
    tell(level, fmt::format("inf-sup constant of c, thickness times {:g}", factor));
    const auto touching = assembly::discretise(space, surface_, describe(thin, true));
    if (const auto c = assembly::contact_inf_sup(*touching)) sample.c_dual = c->dual, sample.c_l2 = c->l2;
    return sample;
  }

  void measure_size(const assembly::DiscreteShell& discrete, Sample& sample) const {
    double area = 0, volume = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
      area += discrete.points[i].weight;
      volume += discrete.points[i].weight * discrete.points[i].thickness;
    }
    area = algebra::sum_over_ranks(area, comm_);
    sample.thickness = algebra::sum_over_ranks(volume, comm_) / area;
    sample.mesh_size = std::sqrt(area / static_cast<double>(discrete.space().global_cells));
  }

  const Problem& problem_;
  std::vector<double> factors_;
  MPI_Comm comm_;
  const StudyObserver& observer_;
  std::shared_ptr<const fem::Surface> surface_{};
};

Table empty_table() {
  return {.name = "stability",
          .title = "Do the constants of coercivity and of the inf-sup conditions hold as h and e go to zero?",
          .columns = {{"factor", "", "1"},
                      {"thickness", "e", "m"},
                      {"level", "", "1"},
                      {"mesh", "h", "m"},
                      {"nodes", "", "1"},
                      {"coercivity", "alpha", "N/m"},
                      {"relative", "alpha / (E e^3)", "1"},
                      {"inf-sup b", "beta_b", "1"},
                      {"inf-sup c", "beta_c", "1"},
                      {"inf-sup c, L2", "beta_c,0", "m"},
                      {"scaled", "beta_c,0 / h", "1"}}};
}

void add_rows(const std::vector<Sample>& samples, Table& table) {
  for (const Sample& s : samples)
    table.rows.push_back({s.factor, s.thickness, static_cast<std::int64_t>(s.level), s.mesh_size, s.nodes, s.alpha,
                          s.relative_alpha, s.b, s.c_dual, s.c_l2, s.c_l2 / s.mesh_size});
}

using Value = double Sample::*;

std::vector<double> column(const std::vector<Sample>& samples, Value value) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& s : samples) values.push_back(s.*value);
  return values;
}

std::vector<Sample> of_factor(const std::vector<Sample>& samples, double factor) {
  std::vector<Sample> some;
  std::ranges::copy_if(samples, std::back_inserter(some), [&](const Sample& s) { return s.factor == factor; });
  return some;
}

std::vector<Sample> of_level(const std::vector<Sample>& samples, int level) {
  std::vector<Sample> some;
  std::ranges::copy_if(samples, std::back_inserter(some), [&](const Sample& s) { return s.level == level; });
  return some;
}

/// Nowhere less than `share` of `reference`.
Claim does_not_degrade(const std::vector<Sample>& samples, Value value, const std::string& symbol, double share,
                       double reference) {
  const auto [low, high] = std::ranges::minmax(column(samples, value));
  return {.statement = symbol + " does not go to zero with the mesh size or the thickness",
          .measured = fmt::format("from {:.4g} to {:.4g}, {:.4g} on the coarsest mesh and the thickest shell", low,
                                  high, samples.front().*value),
          .holds = low > share * reference};
}

bool measured(const std::vector<Sample>& samples, Value value) { return !std::isnan(samples.front().*value); }

void examine_coercivity(const std::vector<Sample>& samples, const Problem& problem, Table& table) {
  if (std::ranges::any_of(samples, [](const Sample& s) { return s.alpha <= 0; })) {
    table.remarks.push_back(
        "alpha is zero: the supports leave a rigid motion free, so a(., .) is not coercive; the obstacle "
        "alone can hold the shell");
    return;
  }
  // Short waves of s across their direction cost mu e^3 / 12 on any shell: no alpha is larger in the limit of fine meshes.
  const double of_short_waves = problem.material.mu / (12 * problem.material.young());
  table.claims.push_back(does_not_degrade(samples, &Sample::relative_alpha, "alpha / (E e^3)", 0.5,
                                          std::min(samples.front().relative_alpha, of_short_waves)));
  const auto finest = of_level(samples, samples.back().level);
  if (finest.size() > 1)
    table.fits.push_back(
        {"alpha", "e", fitted_exponent(column(finest, &Sample::thickness), column(finest, &Sample::alpha))});
}

void examine_contact(const std::vector<Sample>& samples, Table& table) {
  table.claims.push_back(
      does_not_degrade(samples, &Sample::c_dual, "beta_c, in the dual norm of H^1,", 0.9, samples.front().c_dual));
  const auto thick = of_factor(samples, samples.front().factor);
  if (thick.size() < 2) return;
  const double exponent = fitted_exponent(column(thick, &Sample::mesh_size), column(thick, &Sample::c_l2));
  table.fits.push_back({"beta_c,0", "h", exponent});
  table.claims.push_back({.statement = "in L2 the constant of c falls like h: no inf-sup condition holds there",
                          .measured = fmt::format("beta_c,0 ~ h^{:.2f}", exponent),
                          .holds = std::abs(exponent - 1) < 0.3});
}

void conclude(const std::vector<Sample>& samples, const Problem& problem, Table& table) {
  table.remarks.push_back(
      "|V|^2 = int |v|^2 + |s|^2 + |grad v|^2 + |grad s|^2: lengths count in metres, so alpha and the betas belong "
      "to this unit of length");
  examine_coercivity(samples, problem, table);
  if (measured(samples, &Sample::b)) {
    table.claims.push_back(does_not_degrade(samples, &Sample::b, "beta_b", 0.9, samples.front().b));
    table.remarks.push_back(
        "b and its norms contain neither the thickness nor the formulation: beta_b is computed once a mesh");
  } else {
    table.remarks.push_back("no support holds a rotation, so b, which sees gradients only, has no inf-sup constant");
  }
  if (measured(samples, &Sample::c_dual))
    examine_contact(samples, table);
  else
    table.remarks.push_back(problem.obstacle ? "no node can move against the obstacle"
                                             : "without obstacle there is no c");
}

Plot plot_of(const std::vector<Sample>& samples) {
  Plot plot{.title = "Constants of coercivity and of the inf-sup conditions",
            .x = {"mesh size h [m]", true},
            .y = {"constant", true},
            .slopes = {{1, "slope 1"}}};
  const auto add = [&](const std::string& label, const std::vector<Sample>& some, Value value, bool dashed = false) {
    if (measured(some, value))
      plot.series.push_back({label, column(some, &Sample::mesh_size), column(some, value), dashed});
  };
  const auto thick = of_factor(samples, samples.front().factor), thin = of_factor(samples, samples.back().factor);
  add("beta_b", thick, &Sample::b);
  add("beta_c, thickest", thick, &Sample::c_dual);
  add("beta_c, thinnest", thin, &Sample::c_dual, true);
  add("beta_c in L2 [m]", thick, &Sample::c_l2);
  add("alpha / (E e^3), thickest", thick, &Sample::relative_alpha);
  add("alpha / (E e^3), thinnest", thin, &Sample::relative_alpha, true);
  return plot;
}

}  // namespace

Report stability(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer) {
  const auto samples = Stability(problem, options, comm, observer).samples();
  Report report{.table = empty_table(), .plot = {}};
  if (samples.empty()) return report.status = contact::Status::interrupted, report;
  add_rows(samples, report.table);
  conclude(samples, problem, report.table);
  report.plot = plot_of(samples);
  return report;
}

}  // namespace plastron::study
