// All output files of a computation. In their order, results.json shows that they are complete.
#pragma once
#include <plastron/io/envelopes.hpp>
#include <plastron/io/results.hpp>
#include <plastron/io/vtu.hpp>
#include <plastron/problem/problem.hpp>
#include <plastron/report/report_scene.hpp>

namespace plastron::workflow {

/// Throws std::runtime_error if a run that writes base.vtu and so on would find a directory in place of a file.
/// Also throws if it would replace one of `inputs`, the files of its case (collective).
void check_replaceable(const std::filesystem::path& directory, const std::string& base,
                       const std::vector<std::filesystem::path>& inputs, MPI_Comm comm);

/// Files of a running computation. Earlier files stay until all are complete. Then the earlier results.json is removed
/// first, and the new one is named last. All functions are collective and throw std::runtime_error.
class Output {
 public:
  /// Makes the directory. Files of fields are base.vtu, obstacles.vtu, and base.pvd with the names of both.
  /// Files of instants are base-0001.vtu and so on, with solid.vtu beside them if `given` requests it. Each envelope of
  /// `given` whose cases have one mesh has a file envelope-NAME.vtu. report.html is written unless `with_report` is false. Files of an earlier run that are not requested are removed.
  Output(std::filesystem::path directory, std::string base, MPI_Comm comm, bool with_report = true,
         problem::Output given = {});

  /// Adds the fields of an instant of the steps (computation::Observer::instant).
  void add_instant(const computation::HistoryEntry& entry, const computation::Solution& solution);
  /// Returns texts on files that were asked for and cannot be written.
  std::vector<std::string> warnings() const;
  /// Adds all files, then gives them their names. The solution is written as .vtu and .plastron, if a finite one
  /// exists. With contact there are contact-boundary.csv, .vtu and contact-forces.csv (without contact, earlier ones
  /// are removed). With steps there are history.csv and history.svg. base.case.toml is written if provenance has
  /// the case's source; report.html and results.json follow. This function sets provenance.files and the names of
  /// solution and copy. `lines` are written as line-NAME.csv.
  /// Returns the names of all files. After an exception before files get their names it may be called again.
  std::vector<std::string> finish(const computation::Result& result, io::Provenance provenance,
                                  const std::vector<problem::Line>& lines = {});

 private:
  std::vector<std::string> add_all(const computation::Result& result, io::Provenance provenance,
                                   const std::vector<problem::Line>& lines);
  void add_fields(const computation::Solution& solution, double time, const std::string& suffix, bool is_in_series);
  void add_text(const std::string& name, const io::Piece& text);
  void add_history(const computation::Result& result);
  void add_checksums();

  std::filesystem::path directory_;
  std::string base_name_;
  io::AtomicFiles files_;
  bool with_report_;
  problem::Output given_;
  std::vector<io::EnvelopeFields> envelopes_{};
  std::vector<io::DataSet> series_{};
  report::SceneFrames frames_{};
  int instants_ = 0;
  std::vector<std::string> names_{};
};

/// Writes all files at once, for a computation without steps.
void write_output(const computation::Result& result, io::Provenance provenance, const std::filesystem::path& directory,
                  const std::string& base, MPI_Comm comm);

}  // namespace plastron::workflow
