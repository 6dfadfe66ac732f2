// Errors that all ranks share. If an exception occurs on one rank alone, the others wait forever in their next
// collective call. Therefore code that may throw on some ranks runs in agreement: then either all ranks throw, or none.
#pragma once
#include <mpi.h>

#include <array>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace plastron::algebra {

/// Returns on every rank the text of the lowest rank whose text is not empty; empty if there is none. (collective)
std::string first_words(std::string mine, MPI_Comm comm);

namespace agreement {

/// Recognises exceptions of type Kind and makes them anew from their text.
struct Kind {
  bool (*is)(const std::exception&);
  void (*raise)(const std::string& words);
};

template <class Exception>
constexpr Kind kind_of() {
  return {[](const std::exception& e) { return dynamic_cast<const Exception*>(&e) != nullptr; },
          [](const std::string& words) { throw Exception(words); }};
}

/// Throws on all ranks the exception of the lowest rank that has one. Its kind is searched in `kinds`, then in the
/// standard library's; otherwise it is a std::runtime_error. Returns if no rank has an exception. (collective)
void raise_alike(const std::exception_ptr& mine, const Kind* kinds, int count, MPI_Comm comm);

}  // namespace agreement

/// Runs `step`, which must not communicate, on every rank of `comm`. If it throws on some ranks, all throw the
/// exception of the lowest of them with the same text. The type is the same if it is one of `Exceptions` (made from a
/// std::string; derived ones first), std::bad_alloc, std::invalid_argument, std::out_of_range or std::logic_error. Any
/// other type is a std::runtime_error on the other ranks. (collective)
template <class... Exceptions, class Step>
auto in_agreement(MPI_Comm comm, Step&& step) {
  constexpr std::array<agreement::Kind, sizeof...(Exceptions)> kinds{agreement::kind_of<Exceptions>()...};
  using Value = decltype(step());
  std::exception_ptr failure;
  if constexpr (std::is_void_v<Value>) {
    try {
      step();
    } catch (...) {
      failure = std::current_exception();
    }
    agreement::raise_alike(failure, kinds.data(), static_cast<int>(kinds.size()), comm);
  } else {
    std::optional<Value> value;
    try {
      value.emplace(step());
    } catch (...) {
      failure = std::current_exception();
    }
    agreement::raise_alike(failure, kinds.data(), static_cast<int>(kinds.size()), comm);
    return std::move(*value);
  }
}

}  // namespace plastron::algebra
