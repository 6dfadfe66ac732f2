// Which of the six rigid motions u = c + w x phi, r = w x a_3 the supports leave free.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>

#include <string>
#include <vector>

namespace plastron::study {

/// Free motions in words.
struct FreeMotions {
  std::vector<std::string> unheld;            ///< nothing resists them
  std::vector<std::string> held_by_obstacle;  ///< they change the gap, so contact may hold them
};

/// For a mesh that lies on this rank alone.
FreeMotions free_rigid_motions(const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates);

}  // namespace plastron::study
