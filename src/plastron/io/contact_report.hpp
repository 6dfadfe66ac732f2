// Contact as files: the boundaries of its zones and the forces at the touching nodes. contact-boundary.csv is for
// programs and people, contact-boundary.vtu for ParaView beside solution.vtu, contact-forces.csv contains the forces.
// Obstacles, zones and lines are counted from 0, as in results.json.
#pragma once
#include <plastron/io/atomic_file.hpp>

#include <plastron/computation/result.hpp>
#include <plastron/solution/contact_forces.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// Returns one row for each point: obstacle,zone,line,x,y,X,Y,Z,rim. Places are as in certificate::BoundaryPoint, on
/// the undeformed touching face; rim is 1 on lines along the shell's rim.
std::string contact_boundary_csv(const solution::Summary& summary);
/// Returns one polyline for each line, on the deformed touching face.
std::string contact_boundary_vtu(const solution::Summary& summary);

/// Returns one row for each touching node: obstacle,x,y,X,Y,Z,u_X,u_Y,u_Z,F_X,F_Y,F_Z,eta,area as in
/// certificate::ContactForce. The sums of F are the reactions of the obstacles.
std::string contact_forces_csv(const std::vector<solution::ContactForce>& forces, bool has_parameters);

/// Adds the three files if there is any contact; returns their names (collective). Throws std::runtime_error.
std::vector<std::string> add_contact_report(const solution::Summary& summary, const computation::Solution& solution,
                                            const std::filesystem::path& directory, AtomicFiles& files);
/// Removes the files of an earlier run where the present run wrote none (collective).
void remove_contact_report(const std::filesystem::path& directory, MPI_Comm comm);

}  // namespace plastron::io
