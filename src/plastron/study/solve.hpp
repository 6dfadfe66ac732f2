// From a problem to its result: the whole computation.
#pragma once
#include <plastron/study/observer.hpp>
#include <plastron/study/problem.hpp>
#include <plastron/study/result.hpp>

#include <mpi.h>

namespace plastron::study {

/// Solves on every mesh of the sequence and certifies the finest solution (collective).
/// Throws fem::DomainError, assembly::SupportError for what is wrong with the problem itself; a computation that does
/// not converge is no exception but a status. Interrupted (Observer::stop), the result is that of the last mesh that was
/// finished; without one there are no levels and no solution.
Result solve(const Problem& problem, MPI_Comm comm, const Observer& observer = {});

}  // namespace plastron::study
