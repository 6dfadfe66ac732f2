// A solved case inside Python: its numbers, its fields as arrays, and its files.
#pragma once
#include "session.hpp"

#include <plastron/computation/result.hpp>
#include <plastron/config/case.hpp>
#include <plastron/io/results.hpp>
#include <plastron/workflow/output.hpp>

#include <pybind11/numpy.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plastron::python {

/// n x 2 parameters, or n x 3 places in space.
using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

class Solved final : public Releasable {
 public:
  /// A case, its result, and its files that are not finished yet; no files for a result that was loaded.
  Solved(config::Case read, computation::Result result, std::optional<io::CaseSource> source,
         std::unique_ptr<workflow::Output> files);

  void release() override;

  const config::Case& read_case() const { return case_; }
  const computation::Result& result() const;

  std::string status() const { return std::string(contact::to_string(result().status)); }
  std::string status_text() const;
  /// Returns the text of results.json.
  std::string results_json() const;
  /// Writes all files and returns their names; only once (collective).
  std::vector<std::string> finish();

  /// Returns points, connectivity, the VTK cell type, point arrays and cell arrays of this rank's cells: (name, unit,
  /// array) of double precision. The arrays own their memory. `scale`: factor of the displacements in the points.
  py::dict fields(double scale) const;
  /// Returns every field at points of Omega (n x 2), or at the points of the mid-surface nearest to points in space (n x 3),
  /// with heights z / e for further stresses: (name, unit, array) (collective).
  py::list values_at(const Points& points, const std::vector<double>& heights) const;

 private:
  const computation::Solution& solution() const;

  config::Case case_;
  std::optional<computation::Result> result_;
  std::optional<io::CaseSource> source_;
  std::unique_ptr<workflow::Output> files_;
};

}  // namespace plastron::python
