#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/vector.hpp>

#include <limits>
#include <new>
#include <stdexcept>

namespace plastron::algebra {
namespace {

using agreement::Kind;
using agreement::kind_of;

/// Returns on every rank the lowest rank for which `speaks` is true (collective).
std::optional<int> lowest_speaker(bool speaks, MPI_Comm comm) {
  constexpr int nobody = std::numeric_limits<int>::max();
  int rank = speaks ? rank_in(comm) : nobody;
  MPI_Allreduce(MPI_IN_PLACE, &rank, 1, MPI_INT, MPI_MIN, comm);
  return rank == nobody ? std::nullopt : std::optional(rank);
}

void broadcast(std::string& words, int speaker, MPI_Comm comm) {
  int length = static_cast<int>(words.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, comm);
  words.resize(static_cast<std::size_t>(length));
  MPI_Bcast(words.data(), length, MPI_CHAR, speaker, comm);
}

constexpr Kind out_of_memory{[](const std::exception& e) { return dynamic_cast<const std::bad_alloc*>(&e) != nullptr; },
                             [](const std::string&) { throw std::bad_alloc(); }};
/// Standard exceptions, derived ones first. The last one matches all.
constexpr std::array standard{out_of_memory, kind_of<std::invalid_argument>(), kind_of<std::out_of_range>(),
                              kind_of<std::logic_error>(), kind_of<std::runtime_error>()};

/// An exception as number and text. Numbers count `kinds` first, then `standard`.
struct Failure {
  int kind;
  std::string words;
};

Failure describe(const std::exception_ptr& failure, const Kind* kinds, int count) {
  const int any = count + static_cast<int>(standard.size()) - 1;
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& e) {
    int kind = 0;
    while (kind < any && !(kind < count ? kinds[kind] : standard[static_cast<std::size_t>(kind - count)]).is(e)) ++kind;
    return {kind, e.what()};
  } catch (...) {
    return {any, "an exception that is no std::exception"};
  }
}

}  // namespace

std::string first_words(std::string mine, MPI_Comm comm) {
  const auto speaker = lowest_speaker(!mine.empty(), comm);
  if (!speaker) return {};
  broadcast(mine, *speaker, comm);
  return mine;
}

void agreement::raise_alike(const std::exception_ptr& mine, const Kind* kinds, int count, MPI_Comm comm) {
  const auto speaker = lowest_speaker(mine != nullptr, comm);
  if (!speaker) return;
  Failure failure = mine ? describe(mine, kinds, count) : Failure{0, {}};
  MPI_Bcast(&failure.kind, 1, MPI_INT, *speaker, comm);
  broadcast(failure.words, *speaker, comm);
  if (*speaker == rank_in(comm)) std::rethrow_exception(mine);  // with all its data, not only its text
  (failure.kind < count ? kinds[failure.kind] : standard[static_cast<std::size_t>(failure.kind - count)])
      .raise(failure.words);
}

}  // namespace plastron::algebra
