#include "solved.hpp"

#include <plastron/computation/evaluation.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/vtu.hpp>
#include <plastron/workflow/solve.hpp>

#include <array>
#include <stdexcept>
#include <utility>

namespace plastron::python {

namespace {

/// Returns an array that takes the values over. Rows of `columns` numbers; a single column gives a plain list.
template <class T>
py::array_t<T> array_of(std::vector<T> values, std::size_t columns) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = owned->data();
  const std::size_t rows = columns == 0 ? 0 : owned->size() / columns;
  const py::capsule owner(owned.get(), [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  owned.release();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)};
  if (columns != 1) shape.push_back(static_cast<py::ssize_t>(columns));
  return py::array_t<T>(shape, data, owner);
}

py::list arrays_of(std::vector<io::GridArray>& arrays) {
  py::list all;
  for (io::GridArray& array : arrays)
    all.append(py::make_tuple(array.name, array.unit,
                              array_of(std::move(array.values), static_cast<std::size_t>(array.components))));
  return all;
}

}  // namespace

Solved::Solved(config::Case read, computation::Result result, std::optional<io::CaseSource> source,
               std::unique_ptr<workflow::Output> files)
    : case_(std::move(read)), result_(std::move(result)), source_(std::move(source)), files_(std::move(files)) {}

void Solved::release() {
  result_.reset();
  files_.reset();
}

const computation::Result& Solved::result() const {
  if (!result_) throw std::runtime_error("the session has ended");
  return *result_;
}

const computation::Solution& Solved::solution() const {
  if (!result().solution) throw std::runtime_error("there is no solution: the status is \"" + status() + "\"");
  return *result().solution;
}

std::string Solved::status_text() const { return computation::status_text(result()); }

std::string Solved::results_json() const {
  io::Provenance provenance = workflow::provenance_of(case_, source_.value_or(io::CaseSource{}));
  provenance.heights = case_.problem.output.heights;
  provenance.units = case_.problem.output.units;
  return io::results_json(result(), provenance).dump();
}

std::vector<std::string> Solved::finish() {
  if (!files_) throw std::runtime_error("there are no files to write");
  const auto names = files_->finish(result(), workflow::provenance_of(case_, *source_), case_.problem.lines);
  files_.reset();
  return names;
}

py::dict Solved::fields(double scale) const {
  const problem::Output& output = case_.problem.output;
  io::GridPiece piece;
  {
    const py::gil_scoped_release release;
    const Turn turn;
    piece = io::surface_piece(
        solution(), {.displacement_scale = scale, .heights = output.heights, .is_double = true, .units = output.units});
  }
  py::dict all;
  all["cell_type"] = static_cast<int>(piece.type);
  all["points"] = array_of(std::move(piece.points), 3);
  all["cells"] = array_of(std::move(piece.connectivity), piece.points_per_cell);
  all["point_arrays"] = arrays_of(piece.point_arrays);
  all["cell_arrays"] = arrays_of(piece.cell_arrays);
  return all;
}

py::list Solved::values_at(const Points& points, const std::vector<double>& heights) const {
  if (points.ndim() != 2 || (points.shape(1) != 2 && points.shape(1) != 3))
    throw py::value_error("points is an array of n x 2 parameters or n x 3 places in space");
  problem::Problem located = case_.problem;
  located.probes.clear();
  const auto at = points.unchecked<2>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i) {
    problem::Probe& probe = located.probes.emplace_back();
    if (at.shape(1) == 2)
      probe.at = {at(i, 0), at(i, 1)};
    else
      probe.in_space = Eigen::Vector3d(at(i, 0), at(i, 1), at(i, 2));
  }
  std::vector<recovery::PointValues> values;
  {
    const py::gil_scoped_release release;
    const Turn turn;
    if (at.shape(1) == 3) problem::locate_points(located);
    std::vector<Eigen::Vector2d> places;
    for (const problem::Probe& probe : located.probes) places.push_back(probe.at);
    values = computation::values_at(solution(), places, "a point");
  }
  const assembly::DiscreteShell& discrete = *solution().discrete;
  const auto present = io::fields_of(io::ingredients_of(discrete), heights, discrete.shell.sections().most_layers());
  std::vector<io::GridArray> arrays;
  for (const io::Field& field : present)
    for (std::size_t c = 0; c < field.arrays.size(); ++c) {
      io::GridArray& array = arrays.emplace_back(io::GridArray{.name = field.arrays[c],
                                                               .unit = case_.problem.output.units.label(field.unit),
                                                               .components = field.is_vector() ? 3 : 1});
      for (const recovery::PointValues& value : values) {
        const auto numbers = field.take(value);
        const auto* from = numbers.data() + (field.is_vector() ? 0 : c);
        array.values.insert(array.values.end(), from, from + array.components);
      }
    }
  return arrays_of(arrays);
}

}  // namespace plastron::python
