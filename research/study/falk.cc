#include <research/study/falk.hpp>

#include <Eigen/LU>
#include <plastron/element/formulation.hpp>
#include <plastron/meshing/sequence.hpp>
#include <research/study/measures.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace plastron::study {

namespace {

using Strains = std::vector<energy::CellStrain>;
using assembly::DiscreteShell;

/// Cartesian again after every coordinate z of an owned node has become change(z, lower, upper).
template <class Change>
algebra::Vector changed_coordinates(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                                    Change&& change) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  algebra::Vector z(y.layout(), coordinates.width), result(y.layout(), 6);
  for (std::size_t i = 0; i < static_cast<std::size_t>(y.layout()->owned); ++i) {
    if (discrete.space().continuity.constrains(i)) continue;
    const Eigen::Matrix<double, 6, 1> at_node = coordinates.basis[i].partialPivLu().solve(
        Eigen::Map<const Eigen::Matrix<double, 6, 1>>(y.local().data() + 6 * i));
    for (int k = 0; k < coordinates.width; ++k) {
      const std::size_t at = coordinates.at(i, k);
      z.local()[at] = change(at_node[k], coordinates.lower.local()[at], coordinates.upper.local()[at]);
    }
  }
  z.update_ghosts();
  coordinates.to_cartesian(z, result);
  return result;
}

Strains strain_difference(const Strains& a, const Strains& b) {
  Strains result;
  result.reserve(a.size());
  for (std::size_t c = 0; c < a.size(); ++c) result.emplace_back(a[c] - b[c]);
  return result;
}

/// int C eps_1 : eps_2 sqrt(a) dx [J].
double product(const energy::ShellOperator& shell, const Strains& first, const Strains& second) {
  double sum = 0;
  for (std::size_t c = 0; c < first.size(); ++c)
    sum += shell.weighted_stresses(c, first[c]).cwiseProduct(second[c]).sum();
  return algebra::sum_over_ranks(sum, shell.space().layout->comm);
}

/// (A y - l)(V) [J].
double residual_work(const DiscreteShell& discrete, const algebra::Vector& y, const algebra::Vector& V) {
  algebra::Vector f(y.layout(), 6);
  discrete.residual(y, f);
  return algebra::dot(f, V);
}

/// The work of the reaction on the change of the gaps between two fields, and the norm of the change, by nodal quadrature.
struct GapChange {
  double work = 0;     ///< <eta, g(to) - g(from)> [J]
  double squared = 0;  ///< |g(to) - g(from)|_0^2 [m^4]
};

GapChange gap_change(const DiscreteShell& discrete, const algebra::Vector& pressure, const algebra::Vector& from,
                     const algebra::Vector& to) {
  const auto obstacles = static_cast<std::size_t>(pressure.block());
  GapChange change;
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    if (!row.is_touchable()) continue;
    const auto k = static_cast<std::size_t>(row.obstacle);
    const double weight = discrete.points[row.node].weight;
    const double g = discrete.nodal_gap(k, row.node, to) - discrete.nodal_gap(k, row.node, from);
    change.work += weight * pressure.local()[row.node * obstacles + k] * g;
    change.squared += weight * g * g;
  }
  const MPI_Comm comm = discrete.space().layout->comm;
  return {algebra::sum_over_ranks(change.work, comm), algebra::sum_over_ranks(change.squared, comm)};
}

/// |eta|_0 of all obstacles together, by the nodal quadrature [Pa m].
double reaction_norm(const DiscreteShell& discrete, const algebra::Vector& pressure) {
  const auto obstacles = static_cast<std::size_t>(pressure.block());
  double sum = 0;
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    if (!row.is_touchable()) continue;
    const double eta = pressure.local()[row.node * obstacles + static_cast<std::size_t>(row.obstacle)];
    sum += discrete.points[row.node].weight * eta * eta;
  }
  return std::sqrt(algebra::sum_over_ranks(sum, discrete.space().layout->comm));
}

/// W_h on one mesh, and what only that mesh can tell of it.
struct Interpolant {
  algebra::Vector y;       ///< of the coarse mesh
  Strains strains;         ///< at the reference's quadrature points
  double coarse_work = 0;  ///< (A_h U_h - l_h)(W_h - U_h) [J]
};

/// Carries the nodal fields of all meshes to the last one.
std::vector<algebra::Vector> carried_to_the_last(const problem::Problem& problem, int meshes,
                                                 const std::vector<Interpolant>& fields, MPI_Comm comm) {
  fem::MeshSequence sequence = meshing::mesh_sequence(problem, comm);
  std::vector<algebra::Vector> carried;
  for (int level = 0; level < meshes; ++level) {
    if (level > 0) sequence.refine(carried);
    if (static_cast<std::size_t>(level) < fields.size()) carried.push_back(fields[static_cast<std::size_t>(level)].y);
  }
  return carried;
}

class Evaluation {
 public:
  Evaluation(const problem::Problem& problem, const computation::Solution& reference,
             const ReferenceStrains& reference_strains, const SeenSolution& seen_reference)
      : shell_(problem.shell),
        charts_(problem.charts),
        reference_(reference),
        reference_strains_(reference_strains),
        seen_reference_(seen_reference) {}

  Interpolant interpolant(const CoarseSolution& coarse) const {
    const auto surface = std::make_shared<const fem::Surface>(coarse.space->coarse, charts_);
    const auto discrete = assembly::discretise(coarse.space, surface, shell_, coarse.state);
    const algebra::Vector W_h =
        nearest_admissible(*discrete, values_at_nodes(*coarse.space, reference_.discrete->shell, reference_.nodal.y));
    return {.y = discrete->shell.interpolation().interpolated(W_h),
            .strains = reference_strains_.of(discrete->shell, W_h),
            .coarse_work = residual_work(*discrete, coarse.y, difference(W_h, coarse.y))};
  }

  /// `carried` is what became of W_h on the reference's mesh.
  FalkTerms terms(const SeenSolution& U_h, const Interpolant& W_h, const algebra::Vector& carried) const {
    const DiscreteShell& discrete = *reference_.discrete;
    const algebra::Vector &U = reference_.nodal.y, &eta = reference_.nodal.pressure;
    const algebra::Vector W_h_here = discrete.shell.interpolation().nodal_values(carried);
    const Strains error = strain_difference(seen_reference_.strains, U_h.strains);
    const Strains missed = strain_difference(seen_reference_.strains, W_h.strains);
    const GapChange interpolation = gap_change(discrete, eta, U, W_h_here);
    const GapChange penetration = gap_change(discrete, eta, U_h.y, nearest_admissible(discrete, U_h.y));
    const algebra::Vector test = virtual_part(discrete, difference(W_h_here, U_h.y));
    return {.error = product(discrete.shell, error, error),
            .interpolation = product(discrete.shell, missed, missed),
            .reaction = interpolation.work + penetration.work,
            .l2_reaction =
                reaction_norm(discrete, eta) * (std::sqrt(interpolation.squared) + std::sqrt(penetration.squared)),
            .consistency = product(discrete.shell, error, strain_difference(W_h.strains, U_h.strains)) -
                           residual_work(discrete, U, test) + W_h.coarse_work};
  }

 private:
  const assembly::ShellDescription& shell_;
  const std::map<std::string, geometry::Chart>& charts_;
  const computation::Solution& reference_;
  const ReferenceStrains& reference_strains_;
  SeenSolution seen_reference_;
};

}  // namespace

algebra::Vector nearest_admissible(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  return changed_coordinates(discrete, y,
                             [](double z, double lower, double upper) { return std::clamp(z, lower, upper); });
}

algebra::Vector virtual_part(const assembly::DiscreteShell& discrete, const algebra::Vector& difference) {
  return changed_coordinates(discrete, difference,
                             [](double z, double lower, double upper) { return lower == upper ? 0.0 : z; });
}

std::string why_without_falk(const problem::Problem& problem) {
  if (element::is_relaxed(problem.shell.tangency.formulation))
    return "a relaxed formulation's form has a part that the energy norm leaves out";
  if (!problem.rigid_bodies.empty()) return "interpolation does not keep the edges of rigid bodies rigid";
  if (std::ranges::any_of(problem.shell.obstacles.all, &obstacle::Obstacle::is_pressed))
    return "positions of pressed obstacles are unknowns beside U";
  return "";
}

std::vector<FalkTerms> falk_terms(const problem::Problem& problem, const computation::Solution& reference,
                                  const ReferenceStrains& reference_strains, const SeenSolution& seen_reference,
                                  std::span<const CoarseSolution> coarse, std::span<const SeenSolution> seen,
                                  MPI_Comm comm) {
  const Evaluation evaluation(problem, reference, reference_strains, seen_reference);
  std::vector<Interpolant> interpolants;
  for (const CoarseSolution& solution : coarse) interpolants.push_back(evaluation.interpolant(solution));
  const auto carried = carried_to_the_last(problem, problem.discretisation.refinements + 1, interpolants, comm);
  std::vector<FalkTerms> terms;
  for (std::size_t l = 0; l < coarse.size(); ++l)
    terms.push_back(evaluation.terms(seen[l], interpolants[l], carried[l]));
  return terms;
}

}  // namespace plastron::study
