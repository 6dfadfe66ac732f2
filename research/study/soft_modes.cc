// The first eight eigenvalues of a(V, W) = theta (V, W)_X without any support: three translations and three rotations are
// the kernel of the strains (the rigid movement lemma). The relaxed forms see r . a_3 through its gradient only, so on
// developable surfaces a constant r . a_3 costs nothing either.
#include <plastron/geometry/frame.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/meshing/sizes.hpp>
#include <research/spectra/spectra.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::study {

namespace {

using element::Formulation;
using spectra::Mode;
using spectra::ModeKind;

constexpr int first_modes = 8;
constexpr std::array formulations{Formulation::tangent, Formulation::penalised, Formulation::mixed,
                                  Formulation::classical};
constexpr double rounding = 1e-13;  // of the eighth stiffness: smaller ones have no digits

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
  double length = 0;                 ///< L of the norm [m]
  std::string classical_left_out{};  ///< why; empty if it is not
};

/// The shell in one formulation, with nothing that holds or loads it.
assembly::ShellDescription free_shell(const problem::Problem& problem, Formulation formulation) {
  assembly::ShellDescription shell = in_formulation(problem, formulation).shell;
  shell.supports.clear();
  shell.loads = {};
  shell.obstacles = {};
  return shell;
}

/// Empty if interrupted.
Samples compute(problem::Problem problem, MPI_Comm comm, const StudyObserver& observer) {
  problem.rigid_bodies.clear();
  Samples samples{.length = meshing::extent(problem)};
  if (problem.charts.size() > 1) samples.classical_left_out = refusal(problem, Formulation::classical);
  fem::MeshSequence meshes = meshing::mesh_sequence(problem, comm);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);
  const int finest = problem.discretisation.refinements;
  for (int level = 0; level <= finest; ++level) {
    if (level > 0) meshes.refine({});
    if (level + 3 < finest) continue;
    for (const Formulation formulation : formulations) {
      if (formulation == Formulation::classical && !samples.classical_left_out.empty()) continue;
      if (computation::wants_to_stop(observer.solve, comm)) return {};
      if (observer.stage) observer.stage(fmt::format("mesh {}: {}", level, element::to_string(formulation)));
      const auto discrete = assembly::discretise(meshes.space(), surface, free_shell(problem, formulation));
      samples.developable = is_developable(*discrete);
      samples.all.push_back({formulation, level, shell_size(*discrete).mesh_size,
                             spectra::softest_modes(*discrete, first_modes, samples.length)});
    }
  }
  std::ranges::stable_sort(samples.all, {}, &Sample::formulation);
  return samples;
}

Table soft_mode_table() {
  return {.name = "soft-modes",
          .title = "Which motions cost nothing once all supports are removed?",
          .columns = {{"formulation", "", "-"},
                      {"level", "", "1"},
                      {"mesh", "h", "m"},
                      {"mode", "", "1"},
                      {"stiffness", "theta", "J"},
                      {"relative", "theta / theta_8", "1"},
                      {"kind", "", "-"}}};
}

void add_rows(const std::vector<Sample>& samples, Table& table) {
  for (const Sample& s : samples)
    for (std::size_t k = 0; k < s.modes.size(); ++k)
      table.rows.push_back({std::string(element::to_string(s.formulation)), static_cast<std::int64_t>(s.level),
                            s.mesh_size, static_cast<std::int64_t>(k + 1), s.modes[k].stiffness,
                            s.modes[k].stiffness / s.modes.back().stiffness,
                            std::string(spectra::to_string(s.modes[k].kind()))});
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
  return column(samples,
                [&](const Sample& s) { return soft > 0 ? s.modes[static_cast<std::size_t>(soft - 1)].stiffness : 0; });
}

Claim counted(const std::vector<Sample>& samples, bool developable) {
  const Sample& finest = samples.back();
  const int normal_rotations = element::is_relaxed(finest.formulation) && developable ? 1 : 0;
  const int t = finest.soft(ModeKind::translation), r = finest.soft(ModeKind::rotation),
            n = finest.soft(ModeKind::normal_rotation);
  const int soft = finest.soft();
  const std::string statement = fmt::format("{}: the soft modes are 3 translations, 3 rotations and {} tilt",
                                            to_string(finest.formulation), normal_rotations == 0 ? "no" : "1");
  if (samples.size() > 1 && samples[samples.size() - 2].soft() != soft)
    return not_judged(statement,
                      fmt::format("their number still changes with the mesh, {} and {} on the last two; take "
                                  "more refinements",
                                  samples[samples.size() - 2].soft(), soft));
  if (soft == 0) return judged(statement, "no soft mode", false);
  const double next = finest.modes[static_cast<std::size_t>(soft)].stiffness;
  const double stiffest = finest.modes[static_cast<std::size_t>(soft - 1)].stiffness;
  return judged(
      statement,
      fmt::format("{} soft modes: {} translations, {} rotations, {} of r.a3; the next is {:.1e} times stiffer", soft, t,
                  r, n, next / std::max(stiffest, 1e-16 * finest.modes.back().stiffness)),
      t == 3 && r == 3 && n == normal_rotations && soft == 6 + normal_rotations);
}

/// theta ~ h^{2k}: the strains of a rigid motion are the error of its interpolation, of degree k. Judged between the finest
/// two meshes where theta is more than rounding.
void examine_rate(const std::vector<Sample>& samples, int degree, Table& table) {
  const std::vector<double> theta = stiffest_soft(samples);
  const std::vector<double> h = column(samples, &Sample::mesh_size);
  const std::string name(element::to_string(samples.front().formulation));
  const std::string statement = fmt::format("{}: the soft modes become free like h^{} or faster", name, 2 * degree);
  std::vector<double> relative;
  for (std::size_t i = 0; i < theta.size(); ++i) relative.push_back(theta[i] / samples[i].modes.back().stiffness);
  const std::size_t fine = last_step_above(relative, rounding);
  if (fine == 0) {
    table.claims.push_back(not_judged(
        statement, samples.back().soft() == 0 ? "there is none"
                   : samples.size() < 2
                       ? "one mesh has no exponent; take more refinements"
                       : fmt::format("they cost {:.1e} of the eighth mode on the finest mesh, and less than {:.0e} is "
                                     "rounding",
                                     relative.back(), rounding)));
    return;
  }
  const double exponent = local_exponents(h, theta)[fine];
  table.fits.push_back({"stiffest soft mode, " + name, "h", exponent});
  table.claims.push_back(judged(statement,
                                fmt::format("the stiffest like h^{:.2f} between meshes {} and {}", exponent,
                                            samples[fine - 1].level, samples[fine].level),
                                exponent > 2 * degree - 0.5));
}

io::Plot plot_of(const std::vector<Sample>& samples) {
  io::Plot plot{.title = "Softest modes of the free shell", .x = {"mesh size h [m]", true}, .y = {"theta [J]", true}};
  for (const Formulation formulation : formulations) {
    const auto some = of(samples, formulation);
    if (some.empty()) continue;
    const std::vector<double> h = column(some, &Sample::mesh_size);
    const std::vector<double> eighth = column(some, [](const Sample& s) { return s.modes.back().stiffness; });
    plot.series.push_back({fmt::format("stiffest soft mode, {}", to_string(formulation)), h, stiffest_soft(some)});
    plot.series.push_back({fmt::format("eighth mode, {}", to_string(formulation)), h, eighth, true});
  }
  return plot;
}

}  // namespace

Report soft_modes(const problem::Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  const Samples samples = compute(problem, comm, observer);
  Report report{.table = soft_mode_table(), .plot = {}};
  if (samples.all.empty()) return report.status = contact::Status::interrupted, report;
  add_rows(samples.all, report.table);
  for (const Formulation formulation : formulations) {
    const auto some = of(samples.all, formulation);
    if (some.empty()) continue;
    report.table.claims.push_back(counted(some, samples.developable));
    examine_rate(some, problem.discretisation.degree, report.table);
  }
  report.table.remarks.push_back(fmt::format(
      "supports, loads and obstacle of the case are left out; p and rho are the case's; the norm takes L = {:.4g} m as "
      "unit of length",
      samples.length));
  if (!samples.classical_left_out.empty())
    report.table.remarks.push_back("classical left out: " + samples.classical_left_out);
  report.table.remarks.push_back(samples.developable
                                     ? "the surface is developable: the relaxed formulations let r . a_3 be constant"
                                     : "the surface is not developable: a constant r . a_3 costs bending energy");
  report.plot = plot_of(samples.all);
  return report;
}

}  // namespace plastron::study
