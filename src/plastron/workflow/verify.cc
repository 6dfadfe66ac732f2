#include <plastron/workflow/verify.hpp>

#include <plastron/domain/domain.hpp>
#include <plastron/geometry/text_file.hpp>
#include <plastron/io/solution_file.hpp>
#include <plastron/workflow/output_directory.hpp>
#include <plastron/workflow/read.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace plastron::workflow {

namespace {

using Failures = std::vector<std::string>;

/// Checks that results.json has checksums of the files that the case names.
void check_names(const config::Case& c, const io::Claims& claims) {
  for (const auto& [name, path] : c.files)
    if (std::ranges::find(claims.files, name, &io::SourceFile::name) == claims.files.end())
      throw io::UnusableResults(
          fmt::format("the case names the file \"{}\", and results.json has no checksum of it", name));
}

/// The mesh of a CAD file is the one that the run has kept: another version of the mesh program makes other cells.
void use_kept_mesh(const std::filesystem::path& directory, problem::Problem& problem) {
  auto* file = std::get_if<domain::MeshFile>(&problem.domain);
  if (!file || !domain::is_cad_file(file->path)) return;
  const std::filesystem::path kept = directory / (std::string(base_name) + ".msh");
  try {
    file->frozen = std::make_shared<const domain::FrozenMesh>(domain::FrozenMesh{
        .text = geometry::TextFile(kept.string(), "mesh of the part", geometry::Lines::end_words).text()});
  } catch (const geometry::FileError& error) {
    throw io::UnusableResults(error.what());
  }
}

computation::Verification recompute(const config::Case& c, const io::Claims& claims, MPI_Comm comm) {
  const auto cells = c.problem.accuracy ? io::stored_cells(claims.solution, comm) : computation::MeshCells{};
  const computation::FinestMesh mesh = computation::finest_mesh(c.problem, comm, cells);
  const bool is_mixed = c.problem.shell.tangency.formulation == element::Formulation::mixed;
  auto solution = io::read_solution(claims.solution, mesh.space,
                                    {.obstacles = static_cast<int>(c.problem.shell.obstacles.all.size()),
                                     .has_multiplier = is_mixed,
                                     .has_lifts = c.problem.admissible && !c.problem.shell.obstacles.empty()});
  return computation::verify(c.problem, mesh, std::move(solution));
}

void judge(const Judgement& judgement, const std::vector<io::Comparison>& settings, Failures& failures) {
  for (const auto* rows : {&judgement.recomputed.result.limits, &judgement.recomputed.membership})
    for (const certificate::CertificateLimit& row : *rows)
      if (!row.holds()) failures.push_back(fmt::format("{} ({})", row.text(), row.reason));
  for (const io::Comparison& c : judgement.numbers)
    if (!c.agrees)
      failures.push_back(fmt::format("results.json claims {} = {}, the recomputed value is {}", c.path,
                                     io::shown(c.claimed), io::shown(c.recomputed)));
  for (const io::Comparison& c : settings)
    failures.push_back(fmt::format("results.json claims {} = {}, the case has {}", c.path, io::shown(c.claimed),
                                   io::shown(c.recomputed)));
  failures.insert(failures.end(), judgement.files.failures.begin(), judgement.files.failures.end());
}

}  // namespace

Judgement verify(const std::filesystem::path& directory, const std::filesystem::path& files, MPI_Comm comm,
                 bool reads_unsolved) {
  const io::Claims claims = io::read_claims(directory, comm);
  Judgement judgement{.claimed = claims.results};
  if (claims.status != contact::to_string(contact::Status::solved)) {
    judgement.failures.push_back(fmt::format("the status of these results is \"{}\"", claims.status));
    if (!reads_unsolved) return judgement;
  }
  if (claims.solution.empty())
    throw io::UnusableResults("results.json names no file with the solution: there is nothing to verify");
  const auto& folder = files.empty() ? claims.case_folder : files;
  io::check_sources(claims, folder, comm);
  const config::Case& c = judgement.read_case.emplace(read_together(
      [&] {
        config::Case read = config::read_case(claims.case_copy, folder);
        use_kept_mesh(directory, read.problem);
        return read;
      },
      comm));
  check_names(c, claims);
  judgement.files = io::compare_checksums(directory, claims.results, comm);
  judgement.recomputed = recompute(c, claims, comm);
  judgement.numbers = io::compare_numbers(claims.results, judgement.recomputed.result);
  judge(judgement, io::differing_settings(claims.results.value("settings", io::Json()), c.effective),
        judgement.failures);
  return judgement;
}

}  // namespace plastron::workflow
