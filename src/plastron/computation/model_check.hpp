// Compares the linear model with the model of finite rotations (M23-M29): one Newton step with mixed integration points from
// the linear solution gives the energy and the reactions of the other model to some per cent, more steps give them as
// exactly as the mesh (docs/methods/finite-rotations.md).
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/problem/problem.hpp>

namespace plastron::computation {

/// Makes the steps on the mesh of the solution, whose totals are `summary`, until they change nothing or as many as the case
/// allows (collective). Throws SupportError, ObstacleError.
ModelCheck check_model(const Solution& solution, const solution::Summary& summary, const problem::ModelSettings& model,
                       const contact::Settings& settings, const Observer& observer);

/// Changes the numbers of a coarser mesh to those of the last one, `summary`: linear ones are known, the others keep their
/// ratio to them. Returns false if this is not possible.
bool carry_to_finer_mesh(const solution::Summary& summary, ModelCheck& check);

}  // namespace plastron::computation
