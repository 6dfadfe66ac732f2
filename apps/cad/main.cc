// plastron-cad: meshes the faces of a CAD file with curved quadrilaterals. The solver starts it and reads the mesh, so that
// what damages Open CASCADE or Gmsh ends this process only.
//
//     plastron-cad PART MESH.msh JOB       JOB: job.hpp, as JSON
//
// Exit codes: 0; 2 with one message on standard error if the part cannot be meshed; a signal where a library fails.
#include "frozen_mesh.hpp"
#include "mid_surface.hpp"
#include "sheets.hpp"

#include <plastron/topology/surface_patch.hpp>

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

/// Sides of cells [mm]: if the case names none, such that some 200 cells fit on the area. Throws PartError if there would be
/// too many.
double size_of(const JoinedPart& part, const Job& job) {
  constexpr double usual = 200, most = 2e5;  // cells
  const double area = area_of(part.shape), size = job.size ? *job.size * job.mm() : std::sqrt(area / usual);
  if (area > most * size * size)
    throw PartError(
        fmt::format("with size = {:.6g} m it would have {:.2g} cells, and at most {:.0f} are made; size must be at "
                    "least {:.3g} m",
                    *job.size, area / (size * size), most, std::sqrt(area / most) / job.mm()));
  return size;
}

/// A mesh without folded cells. Cells that are larger than the features of the part fold over, and Gmsh does not say so: smaller
/// ones are tried there. Where edges of a face are tangent to each other, no mesh is good: there the best one is taken.
SampledMesh meshed(const JoinedPart& part, double size, bool is_given) {
  constexpr double smaller = 0.7;
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
      if (best_shape > (k == 0 ? fair_shape : least_shape)) break;
      for (const SampledMesh::BadCell& cell : mesh.bad)
        if (k == 0 || cell.shape <= least_shape) small.push_back(cell.remedy);
    } catch (const PartError& error) {
      mistake = error.what();
      size *= smaller;
    }
  if (best && best_shape > least_shape) {
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

std::vector<std::string> notes_of(const std::string& unit, std::size_t faces, const JoinedPart& part,
                                  const SampledMesh& mesh, double size, const Job& job) {
  const double mm = job.mm();
  std::vector<std::string> notes;
  std::set<int> numbers;
  for (const LabelledFace& face : part.labelled) numbers.insert(face.number);
  const double area = precise_area_of(part.shape);
  const bool is_moved = std::ranges::any_of(part.labelled, [](const LabelledFace& face) { return face.to_middle > 0; });
  double of_cells = 0;
  for (const auto& cell : topology::patch_integrals(mesh.surface, Vector3d::Zero())) of_cells += cell.area;
  notes.push_back(
      fmt::format("{} of {} faces of the file{} are meshed, {:.10g} m^2{}; {} cells of degree {} "
                  "with sides of about {:.3g} m, whose area differs by {:.1e} of it",
                  numbers.size(), faces, unit.empty() ? "" : fmt::format(" (in {})", unit), area / (mm * mm),
                  is_moved ? " before they are moved" : "", mesh.surface.cells.size(), mesh.degree, size / mm,
                  std::abs(of_cells - area) / area));
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
  constexpr double negligible = 1e-6;
  if (part.lost_area > negligible * area_of(part.shape))
    notes.push_back(
        fmt::format("warning: faces lie on others, or are narrower than the tolerance: {:.6g} m^2 count once",
                    part.lost_area / (mm * mm)));
  if (part.joined_edges > 0)
    notes.push_back(fmt::format("{} edges of two faces were made one (tolerance {:.2g} m)", part.joined_edges,
                                part.tolerance / mm));
  if (part.imprinted > 0)
    notes.push_back(
        fmt::format("at {} places faces meet without a common edge; they were divided there", part.imprinted));
  return notes;
}

/// Thickness of a region in the case, if it is one number [mm].
std::optional<double> thickness_of(const std::string& region, const Job& job) {
  const auto own = std::ranges::find(job.regions, region, &Selection::name);
  const auto thickness = own == job.regions.end() ? job.thickness : own->thickness;
  return thickness ? std::optional(*thickness * job.mm()) : std::nullopt;
}

/// Tells each thickness of sheets once, and each that differs from the thickness of its region in the case.
void add_notes_on_thickness(const JoinedPart& part, const PartNames& names, std::size_t solids, const Job& job,
                            std::vector<std::string>& notes) {
  constexpr double same = 0.01;
  std::map<double, std::set<int>> faces;                       // numbers by thickness
  std::map<std::pair<std::string, double>, std::string> told;  // by thickness of the solid and of the case
  for (std::size_t i = 0; i < part.labelled.size(); ++i) {
    const LabelledFace& face = part.labelled[i];
    if (face.thickness == 0) continue;
    const auto known = std::ranges::find_if(
        faces, [&](const auto& f) { return std::abs(f.first - face.thickness) <= same * f.first; });
    (known == faces.end() ? faces[face.thickness] : known->second).insert(face.number);
    const auto given = thickness_of(names.regions[i], job);
    if (given && std::abs(*given - face.thickness) > same * face.thickness)
      told.emplace(std::pair(fmt::format("{:.6g}", face.thickness / job.mm()), *given / job.mm()),
                   fmt::format("face {}", face.number));
  }
  for (const auto& [thickness, numbers] : faces)
    notes.push_back(fmt::format("{} of the faces are one side of a sheet of {:.6g} m; the shell is its middle",
                                numbers.size(), thickness / job.mm()));
  if (!faces.empty() && job.offset != 0)
    notes.push_back(
        fmt::format("warning: offset = {:g} moves the shell away from the middle of the sheet", job.offset));
  for (const auto& [thicknesses, face] : told)
    notes.push_back(
        fmt::format("warning: the solid is {} m thick at {}, and the shell has the thickness {:.6g} m there",
                    thicknesses.first, face, thicknesses.second));
  if (faces.empty() && solids > 0)
    notes.push_back(
        "warning: no solid of the file is a sheet of one thickness, and the shell is their skin; if this is not meant, "
        "choose faces = [...], or export the mid-surface");
}

/// The volume of sheets is the area of their middles times their thickness, unless their rims are round or slanted.
void add_note_on_volume(const PartFile& file, const JoinedPart& part, const SampledMesh& mesh, double overlap,
                        const Job& job, std::vector<std::string>& notes) {
  constexpr double allowed = 0.01;
  const auto integrals = topology::patch_integrals(mesh.surface, Vector3d::Zero());
  double of_middles = 0, of_solids = 0;
  for (std::size_t c = 0; c < integrals.size(); ++c)
    of_middles +=
        integrals[c].area * part.labelled[static_cast<std::size_t>(mesh.surface.cells[c].region) - 1].thickness;
  if (of_middles == 0) return;
  of_middles -= overlap;
  for (const TopoDS_Shape& solid : file.solids) of_solids += volume_of(solid);
  const double cubic = std::pow(job.mm(), 3);
  if (std::abs(of_middles - of_solids) > allowed * of_solids)
    notes.push_back(
        fmt::format("warning: area times thickness of the middle is {:.6g} m^3, and the volume of the solid is "
                    "{:.6g} m^3: round, chamfered or slanted rims, or fillets, are not in the shell",
                    of_middles / cubic, of_solids / cubic));
}

void mesh_part(const Job& job, const std::string& path) {
  PartFile file = read_part(job);
  const std::size_t faces = file.faces.size();
  const bool takes_middles = job.faces.is_null() && !job.takes_skins;
  const SheetSides sides = takes_middles ? with_sides_of_sheets(file) : SheetSides{.faces = chosen_faces(file, job)};
  file.faces = sides.faces;
  const JoinedPart part = joined(file, job.tolerance ? std::optional(*job.tolerance * job.mm()) : std::nullopt);
  const PartNames names = names_of(part, job);
  const double size = size_of(part, job);
  SampledMesh mesh = meshed(part, size, job.size.has_value());
  std::vector<std::string> notes = notes_of(file.unit, faces, part, mesh, size, job);
  if (takes_middles) {
    move_to_middle(file, part, mesh);
    if (sides.joints > 0)
      notes.push_back(
          fmt::format("at {} edges ribs were extended to the middle of the sheet that they meet", sides.joints));
    add_notes_on_thickness(part, names, file.solids.size(), job, notes);
    add_note_on_volume(file, part, mesh, sides.overlap, job, notes);
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
  job.offset = json.value("offset", 0.0);
  job.takes_skins = json.value("skins", false);
  if (json.contains("faces")) job.faces = json["faces"];
  const auto selections = [&](const char* key, std::vector<Selection>& all) {
    if (json.contains(key))
      for (const auto& one : json[key])
        all.push_back({one.at("name").get<std::string>(), one.at("selector"),
                       one.contains("thickness") ? std::optional(one["thickness"].get<double>()) : std::nullopt});
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
