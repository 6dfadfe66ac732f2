// The contact problem of a level with finite rotations: Newton steps, and a descent where they do not come to rest.
#pragma once
#include <plastron/computation/level_run.hpp>

namespace plastron::computation {

/// Solves from the state of the shell and an expected zone; null if there is none (collective).
Found solved_finite(LevelRun& run, const algebra::Vector* zone);

}  // namespace plastron::computation
