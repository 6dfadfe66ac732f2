// Functions of Python as given functions of expressions. Each module has its own names, because each has its own copy of the
// library.
#pragma once
#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/given_function.hpp>

#include <pybind11/numpy.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <string>
#include <utility>

namespace plastron::python {

namespace py = pybind11;

/// Ctrl-C, or another exception that is not an error, in a function of Python. It ends the computation like an error of the
/// function, and is raised afterwards by raising_interruptions().
inline std::exception_ptr& interruption() {
  static std::exception_ptr pending;
  return pending;
}

/// Calls `work`, which may call functions of Python. An interruption in one of them is raised in place of the result, and in place of
/// any error: the library may have made a FunctionError into an error of the case, of a file, or of another rank. Each binding that may
/// call functions of Python goes through this: the next call would raise an interruption that is left over. `work` returns a value.
template <class Work>
auto raising_interruptions(Work&& work) {
  const auto raise_pending = [] {
    if (auto pending = std::exchange(interruption(), nullptr)) std::rethrow_exception(pending);
  };
  try {
    auto value = work();
    raise_pending();
    return value;
  } catch (...) {
    raise_pending();
    throw;
  }
}

/// Calls `function`(places, first, count) with places as an array of n x 5 (x, y, X, Y, Z); it returns count x n numbers.
class PythonFunction {
 public:
  explicit PythonFunction(py::object function) : function_(std::move(function)) {}
  PythonFunction(const PythonFunction&) = delete;
  PythonFunction& operator=(const PythonFunction&) = delete;
  ~PythonFunction() {
    if (Py_IsInitialized() == 0) {
      function_.release();  // the interpreter has ended
      return;
    }
    const py::gil_scoped_acquire acquire;
    function_ = py::object();
  }

  void operator()(std::span<const geometry::Place> places, int first, int count, std::span<double> values) const {
    const py::gil_scoped_acquire acquire;
    try {
      py::array_t<double> at({places.size(), std::size_t{5}});
      auto rows = at.mutable_unchecked<2>();
      for (std::size_t i = 0; i < places.size(); ++i) {
        const geometry::Place& p = places[i];
        const std::array<double, 5> row{p.x, p.y, p.X, p.Y, p.Z};
        for (std::size_t k = 0; k < row.size(); ++k) rows(i, k) = row[k];
      }
      using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
      const auto result = function_(at, first, count).cast<Numbers>();
      if (static_cast<std::size_t>(result.size()) != values.size())
        throw geometry::FunctionError("a function returns another number of values than places");
      std::copy_n(result.data(), values.size(), values.begin());
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_Exception)) interruption() = std::current_exception();
      throw geometry::FunctionError(py::str(error.value()).cast<std::string>());
    }
  }

 private:
  py::object function_;
};

/// Gives a function of Python a name in this module's cases. `depends_on`: whether it takes x, y, X, Y, Z.
inline void give_function(const std::string& name, const std::array<bool, 5>& depends_on, py::object function) {
  auto shared = std::make_shared<PythonFunction>(std::move(function));
  geometry::give_function(
      name, {.uses_parameters = depends_on[0] || depends_on[1],
             .uses_space = depends_on[2] || depends_on[3] || depends_on[4],
             .depends_on = {depends_on[2], depends_on[3], depends_on[4]},
             .evaluate = [shared](std::span<const geometry::Place> places, int first, int count,
                                  std::span<double> values) { (*shared)(places, first, count, values); }});
}

}  // namespace plastron::python
