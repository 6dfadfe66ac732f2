// Forces that supports carry at points. A shell held in three points against its rigid motions needs none where its loads
// are in equilibrium; any that is left has no limit as the mesh is refined (docs/model.md, section 6).
#pragma once
#include <plastron/assembly/supports.hpp>
#include <plastron/computation/result.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// One for the point whose reaction is largest, where that is beyond a millionth of the loads.
std::vector<std::string> point_support_warnings(const Result& result, const std::vector<assembly::Support>& supports);

}  // namespace plastron::computation
