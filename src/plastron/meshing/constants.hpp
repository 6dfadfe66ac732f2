// All tuning constants of automatic meshes, and of the strategy that refines them until an accuracy is reached. Most were
// measured on the problems of docs/methods/layers.md and docs/methods/accuracy.md.
#pragma once
#include <cstddef>

namespace plastron::meshing {

struct Constants {
  // Start meshes: rows along edges (layers.md, "The rule").
  double row_width = 3.5;         ///< width of a row [widths of its layer]
  double largest_row = 0.25;      ///< largest width of a row [width of the domain]
  double narrow_row_width = 0.2;  ///< width of a second row at the edge [widths of its layer]
  int narrow_row_degree = 4;      ///< the degree with narrow rows; others need more unknowns with them
  double corner_error = 0.03;     ///< error with one row in each direction [square of the row's part of the domain]
  double cell_corner_sine = 0.7;  ///< rows of polygons cross in a cell above this sine: between 45 and 135 degrees
  double straight_sine = 1e-3;    ///< sine below which a side of a polygon continues straight
  // Start meshes: cells between the rows.
  double cell_size = 0.68;      ///< largest size of a cell per degree [width of the layers inside]
  double excess_size = 0.05;    ///< part by which a cell may be larger, to save a row of cells
  int most_cells_across = 64;   ///< where the chart has almost no curvature, or the shell is very thin
  int least_cells_around = 4;   ///< least number of Gmsh's triangles along the sides of a polygon
  double contact_nodes = 700;   ///< nodes of meshes without accuracy, where a contact zone may have its edge anywhere
  double ring_core = 0.35;      ///< radius beyond which a disk has rings, for round edges of zones [radius]
  int ring_degree = 4;          ///< highest degree with rings: patches of higher ones cannot judge long bent cells
  int degree_smooth = 8;        ///< degree that needs the fewest unknowns for 1e-3 without obstacles
  int degree_with_contact = 3;  ///< the same with obstacles
  int degree_of_triangles = 2;  ///< the highest degree of triangles

  // Samples of the shell.
  int edge_samples = 16;         ///< points of each edge and region for the widths of layers
  int interior_samples = 8;      ///< points of a cell of the domain's mesh in each direction
  double flat_curvature = 1e-6;  ///< Gauss curvature above which there are no asymptotic lines [square of k_1 + k_2]
  int sampled_cells = 256;       ///< least number of cells on which sizes of the shell and of cells are sampled

  // Cuts of chords (accuracy.md, "Chords").
  double chord_worth = 1.2;           ///< least worth of a chord that is cut [worth of single cells]
  double chord_worth_at_edges = 0.3;  ///< the same where edges of zones run along chords: cells there divide repeatedly
  double best_chord_part = 0.6;       ///< least worth of a chord that is cut [worth of the best chord]
  double alike_chords = 0.99;         ///< ratio above which worths are equal: rounding must not break a symmetry
  double edge_chord_cells = 2;  ///< edges run along chords if those have fewer cells [number of cells at the edges]
  double least_cut_part = 0.2;  ///< least part of a cell's side after a cut
  double most_slender = 16;     ///< length of a part where a motion has lost its stiffness [its width]
  double middle_part = 0.1;     ///< cuts nearer to the middle than this part halve the cell
  double straight_bend = 0.1;   ///< largest bend of a straight side [width of the cell]
  double largest_bend = 2;      ///< largest bend of a side after a cut, which patches can judge [width of the part]
  int bent_degree = 4;          ///< highest degree at which bent cells are cut, for the same reason

  // Marks of single cells (accuracy.md, "The loop").
  double aim = 0.9;              ///< error to which a mesh is refined [allowed error]
  double kept_error = 0.25;      ///< part of a divided cell's error that remains at the edge of a contact zone
  double most_divided = 0.8;     ///< largest part of the errors in the cells that are divided at once
  double threshold_step = 0.97;  ///< steps of the threshold above which cells are divided, for symmetry
  double joined_error = 0.01;    ///< largest error of a joined cell [threshold above which cells are divided]
  double rounding_error = 1e-6;  ///< error below which the largest cells are random [allowed error]
  double slow_fall = 0.9;  ///< as many cells as can be are divided if the error is larger [error two meshes before]
  double smallest_cell = 0x1p-24;  ///< side of the smallest cell [cell of the first mesh]; p4est ends at 2^-29

  // End of the loop (accuracy.md, "The loop" and "Edges of contact zones").
  double edge_tolerance = 15;          ///< allowed change of a zone's edge at one degree more [tolerance of the energy]
  double least_edge_tolerance = 1e-3;  ///< its least value [size of the zone]
  double edge_growth = 2;              ///< unknowns for edges alone [unknowns on which the numbers are accurate]
  double unlimited_decay = 0.9;        ///< a number has no limit if all its last changes are larger [change before]
  std::size_t unlimited_changes = 6;   ///< number of these changes
  double doubtful_decay = 0.7;         ///< the same for a remark where the loop ends for another reason
  std::size_t doubtful_changes = 3;    ///< number of these changes
  std::size_t stalled_meshes = 6;      ///< estimates stall if the least one of the last meshes
  double stalled_fall = 0.8;           ///< is not below this part of the least one before,
  double stalled_growth = 3;           ///< although the number of unknowns grew by this factor
  double cost_exponent = 1.3;          ///< growth of a mesh's time with its unknowns (docs/performance.md)
};

inline constexpr Constants constants{};

}  // namespace plastron::meshing
