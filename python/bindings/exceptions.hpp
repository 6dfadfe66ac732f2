// Exceptions of plastron.errors, raised from C++.
#pragma once
#include <plastron/config/mistakes.hpp>

#include <pybind11/pybind11.h>

#include <string>

namespace plastron::python {

namespace py = pybind11;

/// Returns a text of the library; bytes that are not UTF-8 are replaced.
inline py::str text_of(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

/// Raises plastron.errors.NAME(text).
[[noreturn]] inline void raise(const char* name, const std::string& text, const py::object& details = py::none()) {
  const py::object type = py::module_::import("plastron.errors").attr(name);
  const py::object error = details.is_none() ? type(text_of(text)) : type(text_of(text), details);
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

/// Raises plastron.CaseError with the text of the command line, and the mistakes as dictionaries.
[[noreturn]] inline void throw_case_error(const config::CaseErrors& errors) {
  py::list mistakes;
  for (const config::Mistake& m : errors.mistakes()) {
    py::dict one;
    one["file"] = text_of(m.file);
    one["line"] = m.line;
    one["column"] = m.column;
    one["what"] = text_of(m.what);
    one["allowed"] = text_of(m.allowed);
    one["advice"] = text_of(m.advice);
    mistakes.append(one);
  }
  raise("CaseError", errors.format(), mistakes);
}

}  // namespace plastron::python
