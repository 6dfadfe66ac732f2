// The faces of a CAD file with their names, joined where their edges meet.
#pragma once
#include "job.hpp"

#include <Eigen/Core>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <optional>
#include <string>
#include <vector>

namespace plastron::cad {

using Eigen::Vector3d;

inline Vector3d vector_of(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
inline Vector3d vector_of(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }
inline gp_Pnt point_of(const Vector3d& p) { return {p[0], p[1], p[2]}; }
inline gp_Vec gp_vec_of(const Vector3d& v) { return {v[0], v[1], v[2]}; }
double length_of(const TopoDS_Shape& shape);        ///< sum over its edges [mm]
double volume_of(const TopoDS_Shape& shape);        ///< [mm^3]
double area_of(const TopoDS_Shape& shape);          ///< [mm^2]
double precise_area_of(const TopoDS_Shape& shape);  ///< to ten digits [mm^2]
double diagonal_of(const TopoDS_Shape& shape);      ///< of a box around it; throws PartError if there is nothing [mm]

/// Name and colour of a face in the CAD file.
struct FaceLabel {
  std::string name{};    ///< empty: none
  std::string colour{};  ///< "#rrggbb", or empty
};

struct LabelledFace {
  TopoDS_Face face;
  FaceLabel label{};
  int number = 0;        ///< in the order of the file, from 1
  double thickness = 0;  ///< of the solid whose side it is; 0: the face itself is the shell [mm]
  double to_middle = 0;  ///< distance from the face to the middle of the solid, against the normal [mm]
};

/// The faces of a file, in millimetres.
struct PartFile {
  std::vector<LabelledFace> faces;
  std::string unit;  ///< name of the file's unit; empty if the file has none
  std::vector<TopoDS_Shape> solids;
};

/// Reads a STEP file (.step, .stp) or a BREP file of Open CASCADE (.brep). Throws PartError.
PartFile read_part(const Job& job);

/// Faces that share their edges, and the edges.
struct JoinedPart {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces, edges;  ///< numbers from 1
  std::vector<LabelledFace> labelled;       ///< of each face of the map
  double tolerance = 0;                     ///< edges nearer than this were made one [mm]
  int joined_edges = 0;                     ///< edges of two faces that were made one
  double lost_area = 0;                     ///< of faces that lie on others or are narrower than the tolerance [mm^2]
  int imprinted = 0;                        ///< places where faces met without a common edge
};

/// Makes one edge of edges within the tolerance, and divides faces along edges that end inside them (T-joints).
JoinedPart joined(const PartFile& part, std::optional<double> tolerance);

}  // namespace plastron::cad
