// plastron._solver: examination, solution, verification and evaluation of cases.
#include "exceptions.hpp"
#include "functions.hpp"
#include "session.hpp"
#include "solved.hpp"

#include <plastron/algebra/agreement.hpp>
#include <plastron/computation/sensitivity.hpp>
#include <plastron/io/mode_file.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/workflow/output_directory.hpp>
#include <plastron/workflow/read.hpp>
#include <plastron/workflow/solve.hpp>
#include <plastron/workflow/verify.hpp>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace plastron::python {

namespace {

/// A case as Python gives it.
struct CaseText {
  std::string text, file_name;
  std::vector<std::string> settings;

  config::Case read(MPI_Comm comm) const {
    return workflow::read_together([&] { return config::parse_case(text, file_name, settings); }, comm);
  }
};

/// Runs a computation without the interpreter's lock, and raises its errors as those of plastron.errors.
template <class Work>
auto computing(Work&& work) {
  if (is_computing()) throw std::runtime_error("a function that a computation calls cannot start another computation");
  using Value = decltype(work());
  try {
    return raising_interruptions([&] {
      std::optional<Value> value;
      const py::gil_scoped_release release;
      const Turn turn;
      workflow::refusing([&] { value.emplace(work()); });
      return std::move(*value);
    });
  } catch (const workflow::RefusedCase& error) {
    raise("CaseError", error.what());
  } catch (const io::UnusableResults& error) {
    raise("ResultsError", error.what());
  } catch (const io::WriteError& error) {
    raise("OutputError", error.what());
  }
}

/// The findings as (severity, text), with the names of the case's units.
std::vector<std::pair<std::string, std::string>> words_of(const std::vector<examination::Finding>& findings,
                                                          const problem::UnitNames& units) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const examination::Finding& finding : findings)
    all.emplace_back(workflow::to_string(finding.severity), units.renamed(finding.text));
  return all;
}

std::vector<examination::Finding> examine(const config::Case& c, MPI_Comm comm) {
  return workflow::examine_together([&] { return examination::examine(c.problem); }, comm);
}

std::vector<std::pair<std::string, std::string>> check(const CaseText& given, const py::object& comm) {
  const MPI_Comm all = communicator(comm);
  return computing([&] {
    const config::Case c = given.read(all);
    return words_of(examine(c, all), c.problem.output.units);
  });
}

/// Throws RefusedCase with the errors among the findings.
void refuse_errors(const std::vector<examination::Finding>& findings, const CaseText& given, const config::Case& c) {
  if (!examination::has_errors(findings)) return;
  std::string text;
  for (const auto& [severity, words] : words_of(findings, c.problem.output.units))
    if (severity != "note") text += given.file_name + ": " + severity + ": " + words + "\n";
  throw workflow::RefusedCase(text);
}

/// Functions of Python that follow a computation; each may be None.
struct Followers {
  py::object phase, iteration, mesh, instant, warning;
};

/// Calls functions of Python from a computation. Their exceptions end the computation, and are raised afterwards.
class Caller {
 public:
  explicit Caller(const Followers& followers) : followers_(followers) {}

  computation::Observer observer(const problem::UnitNames& units) {
    computation::Observer o;
    o.phase = [this](int level, std::string_view name) { call(followers_.phase, level, std::string(name)); };
    o.iteration = [this](int level, const contact::Iteration& i) {
      call(followers_.iteration, level, io::record_json(io::iteration_quantities(), i).dump());
    };
    o.level = [this](int level, const computation::Level& record) {
      call(followers_.mesh, level, io::record_json(io::level_quantities(), record).dump());
    };
    o.instant = [this](const computation::HistoryEntry& entry, const computation::Solution&) {
      call(followers_.instant, io::record_json(io::history_quantities(), entry).dump());
    };
    o.warning = [this, units](std::string_view text) { call(followers_.warning, units.renamed(text)); };
    o.stop = [this] { return wants_to_stop(); };
    return o;
  }

  bool is_interrupted() const { return is_interrupted_; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  template <class... Args>
  void call(const py::object& function, const Args&... args) {
    const py::gil_scoped_acquire acquire;
    look_for_signals();
    if (function.is_none() || failure_) return;
    try {
      function(args...);
    } catch (py::error_already_set& error) {
      if (error.matches(PyExc_KeyboardInterrupt))
        is_interrupted_ = true;
      else
        failure_ = std::current_exception();
    }
  }

  /// Notes Ctrl-C; other signals that raise are failures.
  void look_for_signals() {
    if (PyErr_CheckSignals() == 0) return;
    if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) {
      PyErr_Clear();
      is_interrupted_ = true;
    } else {
      failure_ = std::make_exception_ptr(py::error_already_set());
    }
  }

  /// Whether Ctrl-C was pressed, also in a function of the case, or a function failed.
  bool wants_to_stop() {
    const py::gil_scoped_acquire acquire;
    look_for_signals();
    return is_interrupted_ || failure_ || interruption();
  }

  const Followers& followers_;
  std::exception_ptr failure_{};
  bool is_interrupted_ = false;
};

/// Solves a case; its files go to `directory`. Returns (solved, whether it was interrupted,
/// the directory, which is that of the first rank on all).
py::tuple solve(const CaseText& given, const std::string& directory, bool is_temporary, bool with_report,
                const py::object& comm, const Followers& followers) {
  const MPI_Comm all = communicator(comm);
  Caller caller(followers);
  std::filesystem::path shared;
  auto solved = computing([&] {
    config::Case c = given.read(all);
    const auto findings = examine(c, all);
    refuse_errors(findings, given, c);
    // The directory of the first rank is everyone's, because temporary names differ.
    shared = algebra::first_words(directory, all);
    std::optional<workflow::OutputDirectory> output;
    if (!is_temporary) output.emplace(shared, workflow::inputs_of(c, given.file_name), all);
    if (output && !output->obstacle().empty())
      throw io::WriteError(shared.string() + ": results cannot be written here: " + output->obstacle());
    io::CaseSource source = workflow::source_of(c, given.file_name, given.settings, all);
    auto files = std::make_unique<workflow::Output>(shared, workflow::base_name, all, with_report && c.wants_report,
                                                    c.problem.output);
    computation::Result result = workflow::solve(c, findings, *files, all, caller.observer(c.problem.output.units));
    if (workflow::is_refused(result.status))
      throw workflow::RefusedCase(given.file_name + ": error: " + workflow::refusal(result) + "\n");
    const bool has_results = !result.levels.empty();
    auto all_of_it = std::make_unique<Solved>(std::move(c), std::move(result), std::move(source), std::move(files));
    if (!is_temporary && has_results) all_of_it->finish();
    return all_of_it;
  });
  caller.rethrow();
  return py::make_tuple(std::move(solved), caller.is_interrupted(), shared.string());
}

/// Returns the texts of results.json for changed cases, next to a solution with its contact held.
std::vector<std::string> results_near(const Solved& solved, const std::vector<CaseText>& changed,
                                      const py::object& comm) {
  const MPI_Comm all = communicator(comm);
  return computing([&] {
    const computation::Sensitivity sensitivity(solved.read_case().problem, solved.result());
    std::vector<std::string> texts;
    for (const CaseText& given : changed) {
      const config::Case c = given.read(all);
      texts.push_back(io::results_json(sensitivity.at(c.problem), workflow::provenance_of(c, {})).dump());
    }
    return texts;
  });
}

/// Returns the judgement as a dictionary with JSON texts, with the names of the case's units.
py::dict verdict_of(const workflow::Judgement& judgement) {
  const problem::UnitNames units =
      judgement.read_case ? judgement.read_case->problem.output.units : problem::UnitNames{};
  py::list rows, numbers, failures;
  for (const auto* limits : {&judgement.recomputed.result.limits, &judgement.recomputed.membership})
    for (const certificate::CertificateLimit& row : *limits)
      rows.append(
          py::make_tuple(std::string(row.row), row.value, row.limit, row.is_least, units.label(row.unit), row.holds()));
  for (const io::Comparison& c : judgement.numbers)
    numbers.append(py::make_tuple(c.path, c.recomputed.dump(), c.claimed.dump(), c.tolerance, c.agrees));
  py::dict all;
  all["rows"] = rows;
  all["numbers"] = numbers;
  for (const std::string& text : judgement.failures) failures.append(units.renamed(text));
  all["failures"] = failures;
  return all;
}

py::dict verify(const std::string& directory, const std::string& files, const py::object& comm) {
  const MPI_Comm all = communicator(comm);
  const workflow::Judgement judgement = computing([&] { return workflow::verify(directory, files, all); });
  return verdict_of(judgement);
}

/// Returns the solution of written results, after their verification, and the judgement.
py::tuple load(const std::string& directory, const std::string& files, const py::object& comm) {
  const MPI_Comm all = communicator(comm);
  workflow::Judgement judgement = computing([&] { return workflow::verify(directory, files, all, true); });
  py::dict verdict = verdict_of(judgement);
  return py::make_tuple(std::make_unique<Solved>(std::move(*judgement.read_case),
                                                 std::move(judgement.recomputed.result), std::nullopt, nullptr),
                        verdict);
}

}  // namespace

}  // namespace plastron::python

PYBIND11_MODULE(_solver, module) {
  using namespace plastron::python;
  module.doc() = "Computations.";
  py::class_<CaseText>(module, "CaseText")
      .def(py::init([](std::string text, std::string file_name, std::vector<std::string> settings) {
        return CaseText{std::move(text), std::move(file_name), std::move(settings)};
      }));
  py::class_<Followers>(module, "Followers")
      .def(
          py::init([](py::object phase, py::object iteration, py::object mesh, py::object instant, py::object warning) {
            return Followers{std::move(phase), std::move(iteration), std::move(mesh), std::move(instant),
                             std::move(warning)};
          }));
  py::class_<Solved>(module, "Solved")
      .def_property_readonly("status", &Solved::status)
      .def_property_readonly("status_text", &Solved::status_text)
      .def("results_json", &Solved::results_json)
      .def("finish",
           [](Solved& solved) {
             return raising_interruptions([&] {
               const py::gil_scoped_release release;
               const Turn turn;
               return solved.finish();
             });
           })
      .def(
          "fields",
          [](const Solved& solved, double scale) {
            return raising_interruptions([&] { return solved.fields(scale); });
          },
          py::arg("scale"))
      .def(
          "values_at",
          [](const Solved& solved, const Points& points, const std::vector<double>& heights) {
            return raising_interruptions([&] { return solved.values_at(points, heights); });
          },
          py::arg("points"), py::arg("heights"));
  // Fields and points are evaluated outside of computing().
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const plastron::geometry::FunctionError& error) {
      raise("CaseError", std::string("error: ") + error.what() + "\n");
    }
  });
  module.def("give_function", &give_function);
  module.def("forget_function", &plastron::geometry::forget_function);
  module.def("rank", [](const py::object& comm) {
    int rank = 0;
    MPI_Comm_rank(communicator(comm), &rank);
    return rank;
  });
  module.def("barrier", [](const py::object& comm) {
    const MPI_Comm all = communicator(comm);
    const py::gil_scoped_release release;
    const Turn turn;
    MPI_Barrier(all);
  });
  module.def("start_session", &start_session, py::arg("threads"));
  module.def("end_session", &end_session);
  module.def("check", &check);
  module.def("solve", &solve);
  module.def("results_near", &results_near);
  module.def("verify", &verify);
  module.def("load", &load);
  module.def("is_mode_name", [](const std::string& name) { return plastron::io::is_mode_name(name); });
  module.def("begin_fork", &begin_fork);
  module.def("end_fork", &end_fork);
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") = module.attr("end_fork"));
  py::module_::import("atexit").attr("register")(module.attr("end_session"));
}
