// From a problem to its result: the whole computation.
#pragma once
#include <plastron/computation/observer.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>

#include <mpi.h>

namespace plastron::computation {

/// Solves on every mesh of the sequence and certifies the finest solution (collective).
/// Throws fem::DomainError, assembly::SupportError for what is wrong with the problem itself; a computation that does
/// not converge is no exception but a status. Interrupted (Observer::stop), the result is that of the last mesh that was
/// finished; without one there are no levels and no solution.
Result solve(const Problem& problem, MPI_Comm comm, const Observer& observer = {});

}  // namespace plastron::computation
