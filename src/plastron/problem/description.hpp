// The data of a problem that its discretisation needs, in one place. A study without the element, the tying or the
// formulation of the case would examine another shell.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/problem/problem.hpp>

namespace plastron::problem {

assembly::ShellDescription shell_description(const Problem& problem);

}  // namespace plastron::problem
