// Errors that all ranks share. An exception on one rank alone leaves the others waiting in their next collective call for ever: so what
// may throw on some ranks is done in agreement, and then either all ranks throw, or none.
#pragma once
#include <mpi.h>

#include <array>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace plastron::algebra {

/// What the lowest rank that has something to say says, on every rank; empty if none has. (collective)
std::string first_words(std::string mine, MPI_Comm comm);

namespace agreement {

/// Tells exceptions of type Kind apart from others and makes them anew from their words.
struct Kind {
  bool (*is)(const std::exception&);
  void (*raise)(const std::string& words);
};

template <class Exception>
constexpr Kind kind_of() {
  return {[](const std::exception& e) { return dynamic_cast<const Exception*>(&e) != nullptr; },
          [](const std::string& words) { throw Exception(words); }};
}

/// The exception of the lowest rank that has one, its kind looked for among `kinds`, then among those of the standard library, at last a
/// std::runtime_error. Returns if no rank has one. (collective)
void raise_alike(const std::exception_ptr& mine, const Kind* kinds, int count, MPI_Comm comm);

}  // namespace agreement

/// Does `step`, which communicates with nobody, on every rank of `comm`. If it throws on some, all throw what the lowest of them threw:
/// the same words, and the same type if that is one of `Exceptions` (made from a std::string; derived ones first), std::bad_alloc,
/// std::invalid_argument, std::out_of_range or std::logic_error; any other is a std::runtime_error elsewhere. (collective)
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
