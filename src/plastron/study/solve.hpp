// From a problem to its result: the whole computation.
#pragma once
#include <plastron/study/problem.hpp>
#include <plastron/study/result.hpp>

#include <mpi.h>

#include <functional>
#include <string_view>

namespace plastron::study {

/// Hears of progress; every member may be empty. Called on every rank.
struct Observer {
  std::function<void(int level, std::string_view phase)> phase{};
  std::function<void(int level, const contact::Iteration&)> iteration{};
  std::function<void(int level, const Level&)> level{};
};

/// Solves on every mesh of the sequence and certifies the finest solution (collective).
/// Throws fem::DomainError, assembly::SupportError for what is wrong with the problem itself; a computation that does
/// not converge is no exception but a status.
Result solve(const Problem& problem, MPI_Comm comm, const Observer& observer = {});

}  // namespace plastron::study
