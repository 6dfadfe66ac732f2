// Reads [mesh].
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

using problem::Discretisation, problem::Layers;

/// Checks triangles, which have degrees 1 and 2 and no tying. A default of `tying` is changed, a given value is an
/// error.
void check_triangles(Table& mesh, problem::Problem& problem) {
  const int degree = problem.discretisation.degree;
  if (degree > 2)
    mesh.report("degree", fmt::format("degree {} is not available on triangles", degree), "1 <= degree <= 2",
                "write cells = \"quadrilateral\" for a higher degree");
  if (problem.shell.tying && mesh.has("tying"))
    mesh.report("tying", "the strains of triangles cannot be tied", "tying = false",
                "leave tying out and use degree 2 on a mesh fine enough, or write cells = \"quadrilateral\"");
  problem.shell.tying = false;
  mesh.effective["tying"] = false;
}

/// Sets missing values for meshes that follow from estimated errors: an unrefined start mesh with edge layers, of high
/// degree.
void suit_accuracy(Table& mesh, Discretisation& d) {
  const bool is_triangular = d.cells == mesh::Shape::triangle;
  if (!mesh.has("refinements")) mesh.effective["refinements"] = d.refinements = 0;
  if (!mesh.has("degree")) mesh.effective["degree"] = d.degree = is_triangular ? 2 : 4;
  if (mesh.has("layers") || is_triangular) return;
  d.layers = Layers::automatic;
  mesh.effective["layers"] = "auto";
}

}  // namespace

std::vector<Section> mesh_sections() {
  return {
      {"mesh",
       "[mesh]",
       "The finite elements, as far as they do not follow from [accuracy].",
       {key("cells", &Discretisation::cells,
            {{"quadrilateral", mesh::Shape::quadrilateral}, {"triangle", mesh::Shape::triangle}},
            {.fallback = "\"quadrilateral\""}, "shape of the cells; triangles have degree 1 or 2 and no tying"),
        key("degree", &Discretisation::degree, {.fallback = "2", .range = Range::between(1, 8)},
            "degree of u and r. Where meshes follow from [accuracy], the default is 4, on triangles 2"),
        key("tying", &assembly::ShellDescription::tying, {.fallback = "true"},
            "tied strains, which prevent locking; false on triangles"),
        key("layers", &Discretisation::layers, {{"auto", Layers::automatic}}, {.fallback = "false"},
            "\"auto\": rows of long thin cells along the edges, as wide as the edge layers of the shell require. "
            "On the finest mesh the other cells are small enough for an error of about 1e-3 (methods/layers.md). A "
            "mesh from a file is not changed. `plastron check` describes the rows. Where meshes follow from "
            "[accuracy], the default is \"auto\", on triangles false"),
        key("refinements", &Discretisation::refinements, {.fallback = "3", .range = Range::between(0, 12)},
            "uniform refinements of the coarsest mesh; every level is solved. On a mesh from a file the default is 0. "
            "With [accuracy], or without [mesh], the default is 0, and only the last level is solved, as the first "
            "of the meshes that follow")}}};
}

void read_mesh(Table& root, problem::Problem& problem) {
  root.in_table("mesh", [&](Table& mesh) {
    Discretisation& d = problem.discretisation;
    mesh.fill(d);
    mesh.fill(problem.shell);
    if (root.has("accuracy") || !root.has("mesh")) suit_accuracy(mesh, d);
    if (!mesh.has("refinements") && std::holds_alternative<domain::MeshFile>(problem.domain))
      mesh.effective["refinements"] = d.refinements = 0;
    if (d.cells == mesh::Shape::triangle) check_triangles(mesh, problem);
  });
}

}  // namespace plastron::config
