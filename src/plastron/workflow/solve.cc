#include <plastron/workflow/solve.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::workflow {

computation::Result solve(const config::Case& c, const std::vector<examination::Finding>& findings, Output& files,
                          MPI_Comm comm, computation::Observer observer) {
  observer.instant = [&files, told = std::move(observer.instant)](const computation::HistoryEntry& entry,
                                                                  const computation::Solution& solution) {
    files.add_instant(entry, solution);
    if (told) told(entry, solution);
  };
  computation::Result result = computation::solve(c.problem, comm, observer);
  for (const std::string& text : files.warnings()) {
    if (observer.warning) observer.warning(text);
    result.warnings.push_back(text);
  }
  for (const examination::Finding& finding : findings)
    if (finding.severity == examination::Severity::warning && std::ranges::count(result.warnings, finding.text) == 0)
      result.warnings.push_back(finding.text);
  return result;
}

io::Provenance provenance_of(const config::Case& c, io::CaseSource source) {
  io::Provenance provenance{.title = c.title, .settings = c.effective, .files = {}, .source = std::move(source)};
  if (const auto* file = std::get_if<domain::MeshFile>(&c.problem.domain); file && file->frozen)
    provenance.part_mesh = {file->frozen, &file->frozen->text};
  return provenance;
}

bool is_refused(contact::Status status) { return status == contact::Status::infeasible; }

std::string refusal(const computation::Result& result) {
  const std::string where = result.history.empty()
                                ? ""
                                : fmt::format("in step \"{}\", at time {:g}: ", result.history.back().step,
                                              result.history.back().factors.time);
  return where + computation::status_text(result);
}

}  // namespace plastron::workflow
