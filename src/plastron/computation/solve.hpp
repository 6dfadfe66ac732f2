// The whole computation, from a problem to its result.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/problem/problem.hpp>

#include <mpi.h>

namespace plastron::computation {

/// Solves on every mesh of the sequence and certifies the finest solution (collective).
/// Throws mesh::DomainError, assembly::SupportError for mistakes in the problem itself. A computation that does
/// not converge is not an exception but a status. If it is interrupted (Observer::stop), the result belongs to the last
/// finished mesh; without one there are no levels and no solution.
Result solve(const problem::Problem& problem, MPI_Comm comm, const Observer& observer = {});

}  // namespace plastron::computation
