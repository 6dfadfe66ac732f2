// Whether a test can watch an assertion stop the program.
#pragma once
#include "algebra/chain.hpp"

namespace plastron::test {

#ifdef NDEBUG
inline constexpr bool assertions_are_live = false;
#else
inline constexpr bool assertions_are_live = true;
#endif

/// If a program dies on one of several ranks, the others die with it.
inline bool cannot_watch_a_program_die() { return !assertions_are_live || ranks() > 1; }

}  // namespace plastron::test
