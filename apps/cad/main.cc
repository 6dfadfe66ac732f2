// plastron-cad: meshes the faces of a CAD file with curved quadrilaterals. The solver starts it and reads the mesh, so that
// what damages Open CASCADE or Gmsh ends this process only.
//
//     plastron-cad PART MESH.msh JOB       JOB: job.hpp, as JSON
//
// Exit codes: 0; 2 with one message on standard error if the part cannot be meshed; a signal where a library fails.
#include "frozen_mesh.hpp"
#include "mid_surface.hpp"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <OSD.hxx>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace plastron::cad {

namespace {

/// Sides of cells where the case names none: some 200 cells on the area.
double default_size(double area) {
  constexpr double cells = 200;
  return std::sqrt(area / cells);
}

/// A mesh without folded cells. Cells that are larger than the features of the part fold over, and Gmsh does not say so: smaller
/// ones are tried there. Where edges of a face are tangent to each other, no mesh is good: there the best one is taken.
SampledMesh meshed(const JoinedPart& part, double size, bool is_given) {
  constexpr double possible = 1e-5, smaller = 0.7;
  constexpr int tries = 8;
  std::string mistake;
  std::optional<Quads> best;
  double best_shape = -2;
  Vector3d best_place = Vector3d::Zero();
  std::vector<SmallPlace> small;
  for (int k = 0; k < tries; ++k) try {
      Quads quads = quads_of(part, size, small);
      SampledMesh mesh = sampled_coarsely(part, quads);
      if (mesh.worst_shape > best_shape) {
        best_shape = mesh.worst_shape;
        best_place = mesh.worst_place;
        best = std::move(quads);
      }
      // A cell between edges that are tangent to each other is flat, however small it is.
      if (best_shape > (k == 0 ? fair_shape : possible)) break;
      for (const SampledMesh::BadCell& cell : mesh.bad)
        if (k == 0 || cell.shape <= possible) small.push_back(cell.remedy);
    } catch (const PartError& error) {
      mistake = error.what();
      size *= smaller;
    }
  if (best && best_shape > possible) {
    const double diagonal = diagonal_of(part.shape);
    SampledMesh mesh = sampled(part, *best, diagonal);
    constexpr double farthest = 1e-3;
    if (mesh.error.distance > farthest * diagonal)
      throw PartError(
          fmt::format("its cells are up to {:.2g} mm off its faces, which are damaged or too curved for them; {}",
                      mesh.error.distance, is_given ? "take a smaller size" : "set size"));
    return mesh;
  }
  if (best)
    mistake =
        fmt::format("a cell folds over at ({:.6g}, {:.6g}, {:.6g}) mm", best_place[0], best_place[1], best_place[2]);
  throw PartError(fmt::format("{}, also with smaller cells; {}", mistake,
                              is_given ? "take a smaller size" : "set size, or mend the part at this place"));
}

std::vector<std::string> notes_of(const PartFile& file, const JoinedPart& part, const SampledMesh& mesh, double size,
                                  const Job& job) {
  const double mm = job.mm();
  std::vector<std::string> notes;
  std::set<int> numbers;
  for (const LabelledFace& face : part.labelled) numbers.insert(face.number);
  notes.push_back(
      fmt::format("{} of {} faces of the file{} are the shell, {:.10g} m^2; {} cells of degree {} with sides of "
                  "about {:.3g} m",
                  numbers.size(), file.faces.size(), file.unit.empty() ? "" : fmt::format(" (in {})", file.unit),
                  area_of(part.shape) / (mm * mm), mesh.cells.size(), mesh.degree, size / mm));
  constexpr double large = 0.01;  // [rad]
  const bool is_rough = mesh.error.direction > large;
  notes.push_back(fmt::format("{}the cells are up to {:.1e} m off the faces, and their normals {:.1e} degrees{}",
                              is_rough ? "warning: " : "", mesh.error.distance / mm,
                              mesh.error.direction * 180 / std::numbers::pi, is_rough ? "; take a smaller size" : ""));
  if (mesh.worst_shape < fair_shape)
    notes.push_back(
        fmt::format("a cell has an angle of {:.2g} degrees at ({:.6g}, {:.6g}, {:.6g}) m, where edges of a face "
                    "nearly touch along each other",
                    std::asin(std::max(0.0, mesh.worst_shape)) * 180 / std::numbers::pi, mesh.worst_place[0] / mm,
                    mesh.worst_place[1] / mm, mesh.worst_place[2] / mm));
  if (part.joined_edges > 0)
    notes.push_back(fmt::format("{} edges of two faces were made one (tolerance {:.2g} m)", part.joined_edges,
                                part.tolerance / mm));
  if (part.imprinted > 0)
    notes.push_back(fmt::format("{} edges end inside of faces, which were divided there", part.imprinted));
  return notes;
}

void mesh_part(const Job& job, const std::string& path) {
  const PartFile file = read_part(job);
  PartFile chosen = file;
  chosen.faces = chosen_faces(file, job);
  const std::vector<ThinSide> sides =
      job.faces.is_null() && !job.takes_skins ? thin_sides(file) : std::vector<ThinSide>{};
  std::map<int, double> thickness;  // by number of the face
  if (!sides.empty()) chosen.faces.clear();
  for (const ThinSide& side : sides)
    for (const LabelledFace& face : side.faces) {
      chosen.faces.push_back(face);
      thickness[face.number] = side.thickness;
    }
  const JoinedPart part = joined(chosen, job.tolerance ? std::optional(*job.tolerance * job.mm()) : std::nullopt);
  const PartNames names = names_of(part, job);
  const double size = job.size ? *job.size * job.mm() : default_size(area_of(part.shape));
  SampledMesh mesh = meshed(part, size, job.size.has_value());
  std::vector<std::string> notes = notes_of(file, part, mesh, size, job);
  if (!sides.empty()) {
    std::vector<double> of_faces;
    for (const LabelledFace& face : part.labelled) of_faces.push_back(thickness.at(face.number));
    move_to_middle(mesh, of_faces);
    for (const ThinSide& side : sides)
      if (const double e = side.thickness / job.mm(); job.thickness && std::abs(*job.thickness - e) > 0.01 * e)
        notes.push_back(fmt::format("warning: the solid is {:.6g} m thick, and [shell] has the thickness {:.6g} m", e,
                                    *job.thickness));
    for (const ThinSide& side : sides)
      notes.push_back(
          fmt::format("the mid-surface of a solid of {:.6g} m thickness is made from the {} faces of one side",
                      side.thickness / job.mm(), side.faces.size()));
  }
  write_mesh(path, mesh, names, job.mm(), notes);
}

/// A part that is damaged must not use the machine up.
void limit_use() {
  constexpr unsigned seconds = 60;
  constexpr rlim_t gigabytes = 4;
  const rlimit memory{gigabytes << 30, gigabytes << 30};
  setrlimit(RLIMIT_AS, &memory);
  const rlimit core{0, 0};
  setrlimit(RLIMIT_CORE, &core);
  alarm(seconds);
}

int run(const std::string& part, const std::string& mesh, const std::string& job) {
  limit_use();
  Message::DefaultMessenger()->ChangePrinters().Clear();
  OSD::SetSignal(false);
  try {
    OCC_CATCH_SIGNALS
    mesh_part(read_job(part, job), mesh);
    return 0;
  } catch (const PartError& error) {
    fmt::print(stderr, "{}\n", error.what());
  } catch (const Standard_Failure& failure) {
    fmt::print(stderr, "Open CASCADE fails at it ({}): the part is damaged; export it again\n",
               failure.DynamicType()->Name());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "it needs more than 4 GB of memory to be meshed; take a larger size\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "it cannot be meshed: {}\n", error.what());
  }
  return 2;
}

}  // namespace

Job read_job(const std::string& part, const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  Job job{.part = part, .unit = json.at("unit").get<double>()};
  const auto number = [&](const char* key) {
    return json.contains(key) ? std::optional(json[key].get<double>()) : std::nullopt;
  };
  job.file_unit = number("file_unit");
  job.default_unit = number("default_unit");
  job.size = number("size");
  job.tolerance = number("tolerance");
  job.thickness = number("thickness");
  job.takes_skins = json.value("skins", false);
  if (json.contains("faces")) job.faces = json["faces"];
  const auto selections = [&](const char* key, std::vector<Selection>& all) {
    if (json.contains(key))
      for (const auto& one : json[key]) all.push_back({one.at("name").get<std::string>(), one.at("selector")});
  };
  if (json.contains("constants"))
    for (const auto& [name, value] : json["constants"].items()) job.constants.emplace_back(name, value.get<double>());
  selections("regions", job.regions);
  selections("boundaries", job.boundaries);
  return job;
}

}  // namespace plastron::cad

int main(int count, char** words) {
  if (count != 4) {
    fmt::print(stderr, "plastron-cad PART MESH.msh JOB is started by plastron\n");
    return 2;
  }
  return plastron::cad::run(words[1], words[2], words[3]);
}
