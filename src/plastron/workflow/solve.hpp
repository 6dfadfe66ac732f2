// A computation from a case to its files, for the command line and for Python.
#pragma once
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/workflow/output.hpp>

#include <mpi.h>

#include <string>
#include <vector>

namespace plastron::workflow {

/// Solves the case as computation::solve() does. Instants of steps are added to `files`, before the observer learns of
/// them. The result has the warnings of the examination and of `files`, too (collective).
computation::Result solve(const config::Case& c, const std::vector<examination::Finding>& findings, Output& files,
                          MPI_Comm comm, computation::Observer observer);

/// Returns the data of results.json besides the result.
io::Provenance provenance_of(const config::Case& c, io::CaseSource source);

/// Whether the status means that the case itself is wrong: there are no results then.
bool is_refused(contact::Status status);

/// Returns where and why the case is wrong. Precondition: is_refused(result.status).
std::string refusal(const computation::Result& result);

}  // namespace plastron::workflow
