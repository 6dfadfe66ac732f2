#include <research/study/error_sequence.hpp>

#include <plastron/computation/solve.hpp>
#include <plastron/meshing/sequence.hpp>
#include <research/spectra/field_norms.hpp>
#include <research/study/measures.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plastron::study {

namespace {

/// The solutions of all levels as the reference mesh sees them: nodal fields (u, r), carried to the finest mesh so far,
/// and the strains that each had on its own mesh. Of the coarsest `compared` levels also what they are solutions of.
class CarriedSolutions {
 public:
  CarriedSolutions(const problem::Problem& problem, std::size_t compared, MPI_Comm comm)
      : meshes_(meshing::mesh_sequence(problem, comm)), reference_(*last_mesh(problem, comm)), compared_(compared) {}

  void add(int level, const computation::Solution& solution) {
    if (level > 0) meshes_.refine(fields_);
    if (meshes_.space()->layout->global_size != solution.nodal.y.layout()->global_size)
      throw std::logic_error("a convergence study needs uniformly refined meshes");
    fields_.push_back(solution.discrete->shell.interpolation().interpolated(solution.nodal.y));
    strains_.push_back(reference_.of(solution.discrete->shell, solution.nodal.y));
    if (coarse_.size() < compared_)
      coarse_.push_back({solution.discrete->shell.space_pointer(), solution.discrete->state, solution.nodal.y});
    cells_.push_back(meshes_.space()->global_cells);
  }
  bool fits(const fem::Space& space) const { return reference_.fits(space); }
  const std::vector<algebra::Vector>& fields() const { return fields_; }
  const std::vector<std::vector<energy::CellStrain>>& strains() const { return strains_; }
  const std::vector<std::int64_t>& cells() const { return cells_; }
  const std::vector<CoarseSolution>& coarse() const { return coarse_; }
  const ReferenceStrains& reference() const { return reference_; }

 private:
  static std::shared_ptr<const fem::Space> last_mesh(const problem::Problem& problem, MPI_Comm comm) {
    fem::MeshSequence meshes = meshing::mesh_sequence(problem, comm);
    for (int i = 0; i < problem.discretisation.refinements; ++i) meshes.refine({});
    return meshes.space();
  }

  fem::MeshSequence meshes_;
  ReferenceStrains reference_;
  std::vector<algebra::Vector> fields_;
  std::vector<std::vector<energy::CellStrain>> strains_;
  std::vector<std::int64_t> cells_;
  std::size_t compared_;
  std::vector<CoarseSolution> coarse_;
};

/// (int C (eps_1 - eps_2) : (eps_1 - eps_2))^{1/2}, the energy norm of a difference of strains [J^{1/2}].
double energy_distance(const energy::ShellOperator& shell, const std::vector<energy::CellStrain>& first,
                       const std::vector<energy::CellStrain>& second) {
  double sum = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    const energy::CellStrain difference = first[c] - second[c];
    sum += shell.weighted_stresses(c, difference).cwiseProduct(difference).sum();
  }
  return std::sqrt(algebra::sum_over_ranks(sum, shell.space().layout->comm));
}

/// All but the energy norm.
Norms field_norms(const energy::ShellOperator& shell, double length, const algebra::Vector& y) {
  const spectra::SquaredNorms s = spectra::squared_norms(shell, y);
  return {.h1 = std::sqrt(s.h1(length)),
          .l2 = std::sqrt(s.l2(length)),
          .h1_u = std::sqrt(s.h1_u(length)),
          .h1_r = std::sqrt(s.h1_r(length)),
          .l2_u = std::sqrt(s.u),
          .l2_r = std::sqrt(s.r)};
}

/// The error of level l against the last level, relative to the norms of the last level.
Norms relative_error(const computation::Solution& reference, const CarriedSolutions& carried, std::size_t l,
                     double length, const Norms& scale) {
  const energy::ShellOperator& shell = reference.discrete->shell;
  Norms error = field_norms(shell, length,
                            difference(shell.interpolation().nodal_values(carried.fields()[l]), reference.nodal.y));
  error.energy = energy_distance(shell, carried.strains()[l], carried.strains().back());
  for (const auto norm : norm_of) error.*norm = scale.*norm > 0 ? error.*norm / scale.*norm : error.*norm;
  return error;
}

/// Over |U|_a^2 = `scale`, if that is not zero.
std::vector<FalkTerms> relative_falk_terms(const problem::Problem& problem, const computation::Solution& reference,
                                           const CarriedSolutions& carried, double scale, MPI_Comm comm) {
  std::vector<algebra::Vector> fields;
  for (std::size_t l = 0; l < carried.coarse().size(); ++l)
    fields.push_back(reference.discrete->shell.interpolation().nodal_values(carried.fields()[l]));
  std::vector<SeenSolution> seen;
  for (std::size_t l = 0; l < fields.size(); ++l) seen.push_back({fields[l], carried.strains()[l]});
  auto all = falk_terms(problem, reference, carried.reference(), {reference.nodal.y, carried.strains().back()},
                        carried.coarse(), seen, comm);
  for (FalkTerms& terms : all)
    for (const auto term : {&FalkTerms::error, &FalkTerms::interpolation, &FalkTerms::reaction, &FalkTerms::l2_reaction,
                            &FalkTerms::consistency})
      if (scale > 0) terms.*term /= scale;
  return all;
}

}  // namespace

std::vector<double> ErrorSequence::of(double Norms::*norm) const { return column(errors, norm); }

ErrorSequence error_sequence(problem::Problem problem, int reference, double length, MPI_Comm comm,
                             computation::Observer observer) {
  const auto compared = static_cast<std::size_t>(problem.discretisation.refinements) + 1;
  problem.discretisation.refinements += reference;
  problem.probes.clear();
  CarriedSolutions carried(problem, compared, comm);
  observer.solution = [&](int level, const computation::Solution& solution) { carried.add(level, solution); };
  const computation::Result result = computation::solve(problem, comm, observer);

  ErrorSequence sequence{.status = result.status, .levels = result.levels};
  for (const computation::Level& level : result.levels)
    if (level.status != contact::Status::solved && sequence.status == contact::Status::solved)
      sequence.status = level.status;
  if (sequence.status != contact::Status::solved) return sequence;
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  if (!carried.fits(discrete.space())) throw std::logic_error("the meshes of two equal sequences differ");
  Norms scale = field_norms(discrete.shell, length, result.solution->nodal.y);
  scale.energy = std::sqrt(2 * result.summary.energy.total());
  sequence.energy_norm = scale.energy;
  sequence.noise = relative_noise(*result.solution, scale.energy);
  sequence.why_without_falk = why_without_falk(problem);
  if (sequence.why_without_falk.empty())
    sequence.falk = relative_falk_terms(problem, *result.solution, carried, scale.energy * scale.energy, comm);
  const double area = shell_size(discrete).area;
  for (std::size_t l = 0; l < compared; ++l) {
    sequence.h.push_back(std::sqrt(area / static_cast<double>(carried.cells()[l])));
    sequence.errors.push_back(relative_error(*result.solution, carried, l, length, scale));
  }
  return sequence;
}

}  // namespace plastron::study
