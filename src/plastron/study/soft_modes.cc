// The first eight eigenvalues of a(V, W) = theta (V, W)_X without any support: three translations and three rotations are
// the kernel of the strains (the rigid movement lemma). The relaxed forms see r . a_3 through its gradient only, so on
// developable surfaces a constant r . a_3 costs nothing either.
#include <plastron/study/stability.hpp>

#include <plastron/assembly/soft_modes.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/study/exponents.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::study {

namespace {

using assembly::Formulation;
using assembly::Mode;
using assembly::ModeKind;

constexpr int first_modes = 8;
constexpr std::array formulations{Formulation::tangent, Formulation::penalised, Formulation::mixed,
                                  Formulation::classical};

/// One formulation on one mesh.
struct Sample {
  Formulation formulation{};
  int level = 0;
  double mesh_size = 0;  ///< h, of a cell [m]
  std::vector<Mode> modes{};

  /// Softer by far than the stiffest of the first modes, which always is a deformation.
  int soft() const {
    constexpr double far = 1e-2;
    return static_cast<int>(
        std::ranges::count_if(modes, [&](const Mode& m) { return m.stiffness < far * modes.back().stiffness; }));
  }
  int soft(ModeKind kind) const {
    const auto first = modes.begin();
    return static_cast<int>(std::count_if(first, first + soft(), [&](const Mode& m) { return m.kind() == kind; }));
  }
};

/// The Gauss curvature is zero everywhere.
bool is_developable(const assembly::DiscreteShell& discrete) {
  double gauss = 0, mean = 0;
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    for (int q = 0; q < discrete.shell.tables().points_per_cell(); ++q) {
      const auto kappa = geometry::principal_curvatures(discrete.shell.point(c, q).frame);
      gauss = std::max(gauss, std::abs(kappa[0] * kappa[1]));
      mean = std::max(mean, std::max(std::abs(kappa[0]), std::abs(kappa[1])));
    }
  const MPI_Comm comm = discrete.space().layout->comm;
  return algebra::max_over_ranks(gauss, comm) <= 1e-8 * std::pow(algebra::max_over_ranks(mean, comm), 2);
}

struct Samples {
  std::vector<Sample> all{};
  bool developable = false;
};

double mesh_size(const assembly::DiscreteShell& discrete) {
  double area = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    area += discrete.points[i].weight;
  area = algebra::sum_over_ranks(area, discrete.space().layout->comm);
  return std::sqrt(area / static_cast<double>(discrete.space().global_cells));
}

/// Empty if interrupted.
Samples compute(const Problem& problem, MPI_Comm comm, const StudyObserver& observer) {
  Samples samples;
  fem::MeshSequence meshes(fem::coarse_mesh(problem.domain), problem.discretisation.degree, comm);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);
  const int finest = problem.discretisation.refinements;
  for (int level = 0; level <= finest; ++level) {
    if (level > 0) meshes.refine({});
    if (level + 3 < finest) continue;
    for (const Formulation formulation : formulations) {
      if (wants_to_stop(observer.solve, comm)) return {};
      if (observer.stage) observer.stage(fmt::format("mesh {}: {}", level, assembly::to_string(formulation)));
      assembly::Tangency tangency = problem.discretisation.tangency;
      tangency.formulation = formulation;
      const auto discrete = assembly::discretise(meshes.space(), surface,
                                                 {.thickness = problem.thickness,
                                                  .material = problem.material,
                                                  .tying = problem.discretisation.tying,
                                                  .tangency = tangency});
      samples.developable = is_developable(*discrete);
      samples.all.push_back(
          {formulation, level, mesh_size(*discrete), assembly::softest_modes(*discrete, first_modes)});
    }
  }
  std::ranges::stable_sort(samples.all, {}, &Sample::formulation);
  return samples;
}

Table empty_table() {
  return {.name = "soft-modes",
          .title = "Which motions cost nothing once all supports are removed?",
          .columns = {{"formulation", "", "-"},
                      {"level", "", "1"},
                      {"mesh", "h", "m"},
                      {"mode", "", "1"},
                      {"stiffness", "theta", "N/m"},
                      {"relative", "theta / theta_8", "1"},
                      {"kind", "", "-"}}};
}

void add_rows(const std::vector<Sample>& samples, Table& table) {
  for (const Sample& s : samples)
    for (std::size_t k = 0; k < s.modes.size(); ++k)
      table.rows.push_back({std::string(assembly::to_string(s.formulation)), static_cast<std::int64_t>(s.level),
                            s.mesh_size, static_cast<std::int64_t>(k + 1), s.modes[k].stiffness,
                            s.modes[k].stiffness / s.modes.back().stiffness,
                            std::string(assembly::to_string(s.modes[k].kind()))});
}

std::vector<Sample> of(const std::vector<Sample>& samples, Formulation formulation) {
  std::vector<Sample> some;
  std::ranges::copy_if(samples, std::back_inserter(some),
                       [&](const Sample& s) { return s.formulation == formulation; });
  return some;
}

/// theta, on every mesh, of the stiffest of the modes that are soft on the finest one.
std::vector<double> stiffest_soft(const std::vector<Sample>& samples) {
  const int soft = samples.back().soft();
  std::vector<double> theta;
  theta.reserve(samples.size());
  for (const Sample& s : samples) theta.push_back(soft > 0 ? s.modes[static_cast<std::size_t>(soft - 1)].stiffness : 0);
  return theta;
}

Claim counted(const Sample& finest, bool developable) {
  const int tilts = assembly::is_relaxed(finest.formulation) && developable ? 1 : 0;
  const int t = finest.soft(ModeKind::translation), r = finest.soft(ModeKind::rotation),
            n = finest.soft(ModeKind::tilt);
  return {
      .statement = fmt::format("{}: the soft modes are 3 translations, 3 rotations and {} tilt",
                               to_string(finest.formulation), tilts == 0 ? "no" : "1"),
      .measured = fmt::format("{} soft modes: {} translations, {} rotations, {} tilt; the next is {:.1e} times stiffer",
                              finest.soft(), t, r, n,
                              finest.modes[static_cast<std::size_t>(finest.soft())].stiffness /
                                  std::max(finest.modes[static_cast<std::size_t>(finest.soft() - 1)].stiffness,
                                           1e-16 * finest.modes.back().stiffness)),
      .holds = t == 3 && r == 3 && n == tilts && finest.soft() == 6 + tilts};
}

/// theta ~ h^{2k}: the strains of a rigid motion are the error of its interpolation, of degree k.
void examine_rate(const std::vector<Sample>& samples, int degree, Table& table) {
  const std::vector<double> theta = stiffest_soft(samples);
  std::vector<double> h;
  h.reserve(samples.size());
  for (const Sample& s : samples) h.push_back(s.mesh_size);
  const std::string name(assembly::to_string(samples.front().formulation));
  if (theta.back() == 0) {
    table.remarks.push_back(name + ": the soft modes are in the discrete space and cost nothing but rounding");
    return;
  }
  const double exponent = local_exponents(h, theta).back();
  if (std::isnan(exponent)) return;
  table.fits.push_back({"stiffest soft mode, " + name, "h", exponent});
  table.claims.push_back(
      {.statement = fmt::format("{}: the soft modes become free like h^{} or faster", name, 2 * degree),
       .measured = fmt::format("the stiffest like h^{:.2f} between the last two meshes", exponent),
       .holds = exponent > 2 * degree - 0.5});
}

Plot plot_of(const std::vector<Sample>& samples) {
  Plot plot{.title = "Softest modes of the free shell", .x = {"mesh size h [m]", true}, .y = {"theta [N/m]", true}};
  for (const Formulation formulation : formulations) {
    const auto some = of(samples, formulation);
    Series softest{
        .label = fmt::format("stiffest soft mode, {}", to_string(formulation)), .x = {}, .y = stiffest_soft(some)};
    Series eighth{.label = fmt::format("eighth mode, {}", to_string(formulation)), .x = {}, .y = {}, .dashed = true};
    for (const Sample& s : some) {
      softest.x.push_back(s.mesh_size);
      eighth.x.push_back(s.mesh_size);
      eighth.y.push_back(s.modes.back().stiffness);
    }
    plot.series.push_back(std::move(softest));
    plot.series.push_back(std::move(eighth));
  }
  return plot;
}

}  // namespace

Report soft_modes(const Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  const Samples samples = compute(problem, comm, observer);
  Report report{.table = empty_table(), .plot = {}};
  if (samples.all.empty()) return report.status = contact::Status::interrupted, report;
  add_rows(samples.all, report.table);
  for (const Formulation formulation : formulations) {
    const auto some = of(samples.all, formulation);
    report.table.claims.push_back(counted(some.back(), samples.developable));
    examine_rate(some, problem.discretisation.degree, report.table);
  }
  report.table.remarks.push_back("supports, loads and obstacle of the case are left out; p and rho are the case's");
  report.table.remarks.push_back(samples.developable
                                     ? "the surface is developable: the relaxed formulations let r . a_3 be constant"
                                     : "the surface is not developable: a constant r . a_3 costs bending energy");
  report.plot = plot_of(samples.all);
  return report;
}

}  // namespace plastron::study
