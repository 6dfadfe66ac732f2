// Forces that supports carry at points. A shell fixed at three points against its rigid motions needs none if its loads
// are in equilibrium. A remaining force has no limit as the mesh is refined (docs/model.md, section 6).
#pragma once
#include <plastron/assembly/supports.hpp>
#include <plastron/computation/result.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Returns one warning for the point with the largest reaction, if this is above a millionth of the loads.
std::vector<std::string> point_support_warnings(const Result& result, const std::vector<assembly::Support>& supports);

}  // namespace plastron::computation
