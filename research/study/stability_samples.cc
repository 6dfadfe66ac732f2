#include <research/study/stability_samples.hpp>

#include <plastron/meshing/sequence.hpp>
#include <research/spectra/inf_sup.hpp>
#include <research/spectra/soft_modes.hpp>
#include <research/study/formulations.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::study {

namespace {

assembly::ShellDescription without_loads(const problem::Problem& problem, bool with_gap) {
  assembly::ShellDescription shell = problem.shell;
  shell.loads = {};
  if (!with_gap) shell.obstacles = {};
  return shell;
}

class Stability {
 public:
  Stability(const problem::Problem& problem, const std::vector<double>& factors, double length, MPI_Comm comm,
            const StudyObserver& observer)
      : problem_(problem), factors_(factors), length_(length), comm_(comm), observer_(observer) {}

  /// Empty if interrupted.
  std::vector<StabilitySample> samples() {
    const int finest = problem_.discretisation.refinements;
    fem::MeshSequence meshes = meshing::mesh_sequence(problem_, comm_);
    surface_ = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem_.charts);
    std::vector<StabilitySample> all;
    for (int level = 0; level <= finest; ++level) {
      if (level > 0) meshes.refine({});
      if (level + 3 < finest) continue;  // h, h/2, h/4, h/8
      const std::optional<double> b = inf_sup_of_b(meshes.space(), level);
      for (const double factor : factors_) {
        if (computation::wants_to_stop(observer_.solve, comm_)) return {};
        all.push_back(measure(meshes.space(), level, factor));
        all.back().b = b.value_or(StabilitySample::no_value);
      }
    }
    std::ranges::stable_sort(all, std::ranges::greater{}, &StabilitySample::factor);
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

  StabilitySample measure(const SpacePointer& space, int level, double factor) {
    const problem::Problem thin = with_thickness_scaled(problem_, factor);
    tell(level, fmt::format("coercivity, thickness times {:g}", factor));
    const auto discrete = assembly::discretise(space, surface_, without_loads(thin, false));
    StabilitySample sample{.factor = factor, .level = level, .nodes = space->layout->global_size};
    measure_size(*discrete, sample);
    sample.alpha = spectra::softest_modes(*discrete, 1, length_).at(0).stiffness;
    sample.relative_alpha = sample.alpha / (problem_.shell.sections.softest().young() * std::pow(sample.thickness, 3));
    if (problem_.shell.obstacles.empty()) return sample;
    tell(level, fmt::format("inf-sup constant of c, thickness times {:g}", factor));
    measure_contact(space, thin, sample);
    return sample;
  }

  /// Takes the least constant over the obstacles, each by itself. Gaps of several obstacles may share a coordinate, and then
  /// their multipliers never act together.
  void measure_contact(const SpacePointer& space, const problem::Problem& thin, StabilitySample& sample) {
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

  void measure_size(const assembly::DiscreteShell& discrete, StabilitySample& sample) const {
    double area = 0, volume = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
      area += discrete.points[i].weight;
      volume += discrete.points[i].weight * discrete.points[i].thickness;
    }
    area = algebra::sum_over_ranks(area, comm_);
    sample.thickness = algebra::sum_over_ranks(volume, comm_) / area;
    sample.mesh_size = std::sqrt(area / static_cast<double>(discrete.space().global_cells));
  }

  const problem::Problem& problem_;
  const std::vector<double>& factors_;
  double length_;  ///< L of the norms [m]
  MPI_Comm comm_;
  const StudyObserver& observer_;
  std::shared_ptr<const fem::Surface> surface_{};
};

}  // namespace

std::vector<StabilitySample> stability_samples(const problem::Problem& problem, const std::vector<double>& factors,
                                               double length, MPI_Comm comm, const StudyObserver& observer) {
  return Stability(problem, factors, length, comm, observer).samples();
}

}  // namespace plastron::study
