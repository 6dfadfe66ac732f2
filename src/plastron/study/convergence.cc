// Errors of every mesh level against a solution some levels finer. The spaces are nested, so a coarse solution is carried
// to the reference mesh exactly, and there the difference is integrated; its strains are those of its own mesh.
#include <plastron/study/convergence.hpp>

#include <plastron/assembly/field_norms.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/study/exponents.hpp>
#include <plastron/study/reference_strains.hpp>
#include <plastron/study/solve.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace plastron::study {

namespace {

/// The solutions of all levels as the reference mesh sees them: nodal fields (u, r), carried to the finest mesh so far,
/// and the strains that each had on its own mesh.
class CarriedSolutions {
 public:
  CarriedSolutions(const Problem& problem, MPI_Comm comm)
      : meshes_(first_mesh(problem, comm)), reference_(*last_mesh(problem, comm)) {}

  void add(int level, const Solution& solution) {
    if (level > 0) meshes_.refine(fields_);
    if (meshes_.space()->layout->global_size != solution.nodal.y.layout()->global_size)
      throw std::logic_error("a convergence study needs uniformly refined meshes");
    fields_.push_back(solution.discrete->shell.interpolation().interpolated(solution.nodal.y));
    strains_.push_back(reference_.of(solution));
    cells_.push_back(meshes_.space()->global_cells);
  }
  bool fits(const fem::Space& space) const { return reference_.fits(space); }
  const std::vector<algebra::Vector>& fields() const { return fields_; }
  const std::vector<std::vector<assembly::CellStrain>>& strains() const { return strains_; }
  const std::vector<std::int64_t>& cells() const { return cells_; }

 private:
  static fem::MeshSequence first_mesh(const Problem& problem, MPI_Comm comm) {
    return {fem::coarse_mesh(problem.domain, problem.discretisation.cells), problem.discretisation.degree, comm};
  }
  static std::shared_ptr<const fem::Space> last_mesh(const Problem& problem, MPI_Comm comm) {
    fem::MeshSequence meshes = first_mesh(problem, comm);
    for (int i = 0; i < problem.discretisation.refinements; ++i) meshes.refine({});
    return meshes.space();
  }

  fem::MeshSequence meshes_;
  ReferenceStrains reference_;
  std::vector<algebra::Vector> fields_;
  std::vector<std::vector<assembly::CellStrain>> strains_;
  std::vector<std::int64_t> cells_;
};

/// (int C (eps_1 - eps_2) : (eps_1 - eps_2))^{1/2}, the energy norm of a difference of strains [J^{1/2}].
double energy_distance(const assembly::ShellOperator& shell, const std::vector<assembly::CellStrain>& first,
                       const std::vector<assembly::CellStrain>& second) {
  double sum = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    const assembly::CellStrain difference = first[c] - second[c];
    sum += shell.weighted_stresses(c, difference).cwiseProduct(difference).sum();
  }
  return std::sqrt(algebra::sum_over_ranks(sum, shell.space().layout->comm));
}

/// Norms of a field, or of an error relative to the reference's.
struct Norms {
  double energy = 0, h1 = 0, l2 = 0, h1_u = 0, h1_r = 0, l2_u = 0, l2_r = 0;
};

constexpr std::array norm_of{&Norms::energy, &Norms::h1,   &Norms::l2,  &Norms::h1_u,
                             &Norms::h1_r,   &Norms::l2_u, &Norms::l2_r};

/// All but the energy norm.
Norms field_norms(const assembly::ShellOperator& shell, const algebra::Vector& y) {
  const assembly::SquaredNorms s = assembly::squared_norms(shell, y);
  return {.h1 = std::sqrt(s.h1()),
          .l2 = std::sqrt(s.l2()),
          .h1_u = std::sqrt(s.u + s.grad_u),
          .h1_r = std::sqrt(s.r + s.grad_r),
          .l2_u = std::sqrt(s.u),
          .l2_r = std::sqrt(s.r)};
}

/// Of level l against the last one, relative to the last one's norms.
Norms relative_error(const Solution& reference, const CarriedSolutions& carried, std::size_t l, const Norms& scale) {
  const assembly::ShellOperator& shell = reference.discrete->shell;
  algebra::Vector difference = shell.interpolation().nodal_values(carried.fields()[l]);
  for (std::size_t i = 0; i < difference.local().size(); ++i) difference.local()[i] -= reference.nodal.y.local()[i];
  Norms error = field_norms(shell, difference);
  error.energy = energy_distance(shell, carried.strains()[l], carried.strains().back());
  for (const auto norm : norm_of) error.*norm = scale.*norm > 0 ? error.*norm / scale.*norm : error.*norm;
  return error;
}

/// The levels of one problem and their errors.
struct Sequence {
  contact::Status status = contact::Status::solved;
  std::vector<Level> levels{};
  std::vector<double> h{};
  std::vector<Norms> errors{};

  std::vector<double> of(double Norms::*norm) const {
    std::vector<double> values;
    for (const Norms& e : errors) values.push_back(e.*norm);
    return values;
  }
};

double area_of(const assembly::DiscreteShell& discrete) {
  double area = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    area += discrete.points[i].weight;
  return algebra::sum_over_ranks(area, discrete.space().layout->comm);
}

Sequence solve_sequence(Problem problem, int reference, MPI_Comm comm, Observer observer) {
  const auto compared = static_cast<std::size_t>(problem.discretisation.refinements) + 1;
  problem.discretisation.refinements += reference;
  problem.probes.clear();
  CarriedSolutions carried(problem, comm);
  observer.solution = [&](int level, const Solution& solution) { carried.add(level, solution); };
  const Result result = solve(problem, comm, observer);

  Sequence sequence{.status = result.status, .levels = result.levels};
  for (const Level& level : result.levels)
    if (level.status != contact::Status::solved && sequence.status == contact::Status::solved)
      sequence.status = level.status;
  if (sequence.status != contact::Status::solved) return sequence;
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  if (!carried.fits(discrete.space())) throw std::logic_error("the meshes of two equal sequences differ");
  Norms scale = field_norms(discrete.shell, result.solution->nodal.y);
  scale.energy = std::sqrt(2 * result.summary.energy.total());
  const double area = area_of(discrete);
  for (std::size_t l = 0; l < compared; ++l) {
    sequence.h.push_back(std::sqrt(area / static_cast<double>(carried.cells()[l])));
    sequence.errors.push_back(relative_error(*result.solution, carried, l, scale));
  }
  return sequence;
}

Table empty_table() {
  return {.name = "convergence",
          .title = "How fast does the error fall with the mesh size?",
          .columns = {{"obstacle", "", "-"},
                      {"level", "", "1"},
                      {"cells", "", "1"},
                      {"unknowns", "", "1"},
                      {"mesh size", "h", "m"},
                      {"energy", "|U - U_h|_a", "1"},
                      {"H1", "|U - U_h|_1", "1"},
                      {"L2", "|U - U_h|_0", "1"},
                      {"H1 of u", "|u - u_h|_1", "1"},
                      {"H1 of r", "|r - r_h|_1", "1"},
                      {"L2 of u", "|u - u_h|_0", "1"},
                      {"L2 of r", "|r - r_h|_0", "1"},
                      {"energy rate", "", "1"},
                      {"H1 rate", "", "1"},
                      {"L2 rate", "", "1"}}};
}

void add_rows(const Sequence& s, const std::string& obstacle, Table& table) {
  const auto energy = local_exponents(s.h, s.of(&Norms::energy));
  const auto h1 = local_exponents(s.h, s.of(&Norms::h1)), l2 = local_exponents(s.h, s.of(&Norms::l2));
  for (std::size_t l = 0; l < s.errors.size(); ++l) {
    std::vector<Entry> row{obstacle, static_cast<std::int64_t>(l), s.levels[l].cells, s.levels[l].unknowns, s.h[l]};
    for (const auto norm : norm_of) row.emplace_back(s.errors[l].*norm);
    row.insert(row.end(), {energy[l], h1[l], l2[l]});
    table.rows.push_back(std::move(row));
  }
}

/// Errors at the rounding of the solver's solution have no rate.
bool at_rounding(const Sequence& s) { return s.errors.back().energy < 1e-9; }

void add_fits(const Sequence& s, const std::string& obstacle, Table& table) {
  for (const auto& [name, norm] :
       {std::pair{"energy error", &Norms::energy}, {"H1 error", &Norms::h1}, {"L2 error", &Norms::l2}})
    table.fits.push_back({fmt::format("{}, {}", name, obstacle), "h", fitted_exponent(s.h, s.of(norm))});
}

Claim falling(const Sequence& s, const std::string& obstacle) {
  const auto errors = s.of(&Norms::energy);
  std::vector<std::string> texts;
  texts.reserve(errors.size());
  for (const double e : errors) texts.push_back(fmt::format("{:.2e}", e));
  return {.statement = fmt::format("{}: the error in the energy norm falls from mesh to mesh", obstacle),
          .measured = fmt::format("{}", fmt::join(texts, ", ")),
          .holds = at_rounding(s) || std::ranges::adjacent_find(errors, std::less_equal<>{}) == errors.end()};
}

Claim reaches(const Sequence& s, const std::string& obstacle, double order, const std::string& why) {
  constexpr double slack = 0.25;  // of a rate measured on few meshes
  const double rate = local_exponents(s.h, s.of(&Norms::energy)).back();
  return {.statement = fmt::format("{}: the energy error falls like h^{:.3g} or faster ({})", obstacle, order, why),
          .measured = at_rounding(s) ? fmt::format("error {:.1e}, rounding", s.errors.back().energy)
                                     : fmt::format("h^{:.2f} between the finest two", rate),
          .holds = at_rounding(s) || rate >= order - slack};
}

void add_series(const Sequence& s, const std::string& obstacle, bool dashed, Plot& plot) {
  for (const auto& [name, norm] : {std::pair{"energy", &Norms::energy}, {"H1", &Norms::h1}, {"L2", &Norms::l2}})
    plot.series.push_back({fmt::format("{}, {}", name, obstacle), s.h, s.of(norm), dashed});
}

void add(const Sequence& s, bool with_obstacle, int degree, Report& report) {
  const std::string obstacle = with_obstacle ? "with obstacle" : "without obstacle";
  add_rows(s, with_obstacle ? "with" : "without", report.table);
  if (s.errors.size() > 1) {
    add_fits(s, obstacle, report.table);
    report.table.claims.push_back(falling(s, obstacle));
    report.table.claims.push_back(with_obstacle
                                      ? reaches(s, obstacle, std::min<double>(degree, 1.25), "Falk's estimate")
                                      : reaches(s, obstacle, degree, "Cea's lemma, a smooth solution"));
  }
  add_series(s, obstacle, with_obstacle, report.plot);
}

void add_slopes(int degree, Plot& plot) {
  plot.slopes.push_back({static_cast<double>(degree), fmt::format("slope {}", degree)});
  plot.slopes.push_back({degree + 1.0, fmt::format("slope {}", degree + 1)});
  if (plot.series.size() > 3 && degree > 1) plot.slopes.push_back({1.5, "slope 3/2"});
}

}  // namespace

Report convergence(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer) {
  const int degree = problem.discretisation.degree;
  Report report{
      .table = empty_table(),
      .plot = {.title = "Error against the mesh size", .x = {"mesh size h [m]", true}, .y = {"relative error", true}}};
  report.table.remarks.push_back(fmt::format(
      "errors are relative to a solution {} levels finer than the finest mesh compared, and measured on its mesh",
      options.reference));
  Problem alone = problem;
  alone.obstacle.reset();
  if (observer.stage) observer.stage("without obstacle");
  const Sequence free = solve_sequence(alone, options.reference, comm, observer.solve);
  const bool held = free.status != contact::Status::singular;
  if (held || !problem.obstacle) {
    report.status = free.status;
    if (free.status != contact::Status::solved) return report;
    add(free, false, degree, report);
  } else {
    report.table.remarks.push_back("the supports alone do not hold the shell, so it is solved with the obstacle only");
  }
  if (problem.obstacle) {
    if (observer.stage) observer.stage("with obstacle");
    const Sequence pressed = solve_sequence(problem, options.reference, comm, observer.solve);
    report.status = pressed.status;
    if (pressed.status != contact::Status::solved) return report;
    add(pressed, true, degree, report);
    if (pressed.levels.back().active == 0) report.table.remarks.push_back("the shell does not touch the obstacle");
  }
  add_slopes(degree, report.plot);
  return report;
}

}  // namespace plastron::study
