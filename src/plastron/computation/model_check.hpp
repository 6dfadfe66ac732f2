// Compares the linear model with the model of finite rotations (M23-M29): one Newton step with mixed integration points from
// the linear solution gives the energy and the reactions of the other model to some per cent (docs/methods/finite-rotations.md).
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/contact/settings.hpp>

namespace plastron::computation {

/// Makes a step on the mesh of the solution, whose totals are `summary`, and more while a step changes them much (collective).
/// Throws SupportError, ObstacleError.
ModelCheck check_model(const Solution& solution, const solution::Summary& summary, const contact::Settings& settings,
                       const Observer& observer);

/// Changes the numbers of a coarser mesh to those of the last one, `summary`: linear ones are known, the others keep their
/// ratio to them. Returns false if this is not possible.
bool carry_to_finer_mesh(const solution::Summary& summary, ModelCheck& check);

}  // namespace plastron::computation
