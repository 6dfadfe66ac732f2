// All output files of a computation, in the order that makes results.json the sign of completeness.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/io/results.hpp>
#include <plastron/io/vtu.hpp>

namespace plastron::io {

/// SHA-256 of all other files, for `plastron verify` and `sha256sum --check`.
inline constexpr std::string_view checksums_name = "SHA256SUMS";

/// Throws std::runtime_error where a run that writes base_name.vtu and so on would meet a directory in the place of a file, or replace one of
/// `inputs`, the files that its case is read from (collective).
void check_replaceable(const std::filesystem::path& directory, const std::string& base_name,
                       const std::vector<std::filesystem::path>& inputs, MPI_Comm comm);

/// Files of a run on their way. Those of an earlier run stay until all are complete; then its results.json goes first, and the new one comes last. All functions are
/// collective and throw std::runtime_error.
class Output {
 public:
  /// Makes the directory. Files of fields are base_name.vtu, obstacles.vtu, base_name.pvd that names both, and of instants
  /// base_name-0001.vtu and so on, with solid.vtu beside them where `given` wants one. report.html is one of them unless `with_report` is false. What is
  /// not wanted is removed where an earlier run has left it.
  Output(std::filesystem::path directory, std::string base_name, MPI_Comm comm, bool with_report = true,
         computation::Output given = {});

  /// The fields of an instant of the steps (computation::Observer::instant).
  void add_instant(const computation::HistoryEntry& entry, const computation::Solution& solution);
  /// The solution as .vtu and .plastron, unless there is none that is finite, contact-boundary.csv, .vtu and contact-forces.csv where there is contact
  /// (those of an earlier run are removed where there is none), history.csv and history.svg where there are steps,
  /// base_name.case.toml if provenance has the case's source, report.html, and results.json; then all files get their names. provenance.files and the
  /// names of solution and copy are filled here. `lines` are tabulated as line-NAME.csv. Returns the names of all files.
  std::vector<std::string> finish(const computation::Result& result, Provenance provenance,
                                  const std::vector<computation::Line>& lines = {});

 private:
  void add_fields(const computation::Solution& solution, double time, const std::string& suffix, bool is_in_series);
  void add_text(const std::string& name, const Piece& text);
  void add_history(const computation::Result& result);
  void add_checksums();

  std::filesystem::path directory_;
  std::string base_name_;
  AtomicFiles files_;
  bool with_report_;
  computation::Output given_;
  std::vector<DataSet> series_{};
  int instants_ = 0;
  std::vector<std::string> names_{};
};

/// All at once, for a computation without steps.
void write_output(const computation::Result& result, Provenance provenance, const std::filesystem::path& directory,
                  const std::string& base_name, MPI_Comm comm);

}  // namespace plastron::io
