// A result's end in words. Apart from what judges it: tables of results name this, and are read without the solver's libraries.
#include <plastron/computation/result.hpp>

#include <fmt/format.h>

namespace plastron::computation {

std::string status_text(const Result& result) {
  std::string text(contact::explain(result.status));
  if (result.status == contact::Status::inaccurate) text += fmt::format(" Beyond its limit: {}.", result.missed_limits);
  if (result.status == contact::Status::accuracy_not_reached) text += fmt::format(" {}.", result.missed_limits);
  return text;
}

}  // namespace plastron::computation
