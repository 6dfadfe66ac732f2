// Exceptions of plastron.errors, raised from C++.
#pragma once
#include <plastron/config/mistakes.hpp>

#include <pybind11/pybind11.h>

#include <string>

namespace plastron::python {

namespace py = pybind11;

/// Raises plastron.errors.NAME(text).
[[noreturn]] inline void raise(const char* name, const std::string& text, const py::object& details = py::none()) {
  const py::object type = py::module_::import("plastron.errors").attr(name);
  const py::object error = details.is_none() ? type(text) : type(text, details);
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

/// Raises plastron.CaseError with the text of the command line, and the mistakes as dictionaries.
[[noreturn]] inline void throw_case_error(const config::CaseErrors& errors) {
  py::list mistakes;
  for (const config::Mistake& m : errors.mistakes()) {
    py::dict one;
    one["file"] = m.file;
    one["line"] = m.line;
    one["column"] = m.column;
    one["what"] = m.what;
    one["allowed"] = m.allowed;
    one["advice"] = m.advice;
    mistakes.append(one);
  }
  raise("CaseError", errors.format(), mistakes);
}

}  // namespace plastron::python
