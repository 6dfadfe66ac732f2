#include "part.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BOPTools_AlgoTools.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom_Surface.hxx>
#include <IntTools_Context.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <ShapeUpgrade_ShapeDivideContinuity.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace plastron::cad {

namespace {

TopoDS_Compound compound_of(const std::vector<LabelledFace>& faces) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const LabelledFace& face : faces) builder.Add(compound, face.face);
  return compound;
}

/// The faces of a shape with the labels of the faces from which they came. `successors(face, visit)` calls visit for each
/// face that came from a face.
template <class Successors>
JoinedPart labelled(const TopoDS_Shape& shape, const std::vector<LabelledFace>& before, const Successors& successors) {
  JoinedPart part{.shape = shape, .faces = {}, .edges = {}, .labelled = {}};
  TopExp::MapShapes(shape, TopAbs_FACE, part.faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, part.edges);
  part.labelled.resize(static_cast<std::size_t>(part.faces.Extent()));
  for (int i = 1; i <= part.faces.Extent(); ++i) part.labelled[i - 1].face = TopoDS::Face(part.faces(i));
  for (const LabelledFace& old : before)
    successors(old.face, [&](const TopoDS_Shape& now) {
      if (const int i = part.faces.FindIndex(now); i > 0) {
        const TopoDS_Face face = TopoDS::Face(part.faces(i));
        // Open CASCADE may turn faces; what is moved to the middle needs its normal.
        const bool is_turned =
            old.to_middle > 0 && BOPTools_AlgoTools::IsSplitToReverse(face, old.face, new IntTools_Context());
        part.labelled[i - 1] = old;
        part.labelled[i - 1].face = is_turned ? TopoDS::Face(face.Reversed()) : face;
      }
    });
  return part;
}

/// Cuts faces along lines inside them where their surfaces have a kink: a fold may lie on an edge only.
std::vector<LabelledFace> divided_at_kinks(const std::vector<LabelledFace>& faces) {
  std::vector<LabelledFace> divided;
  for (const LabelledFace& face : faces) {
    if (BRep_Tool::Surface(face.face)->Continuity() != GeomAbs_C0) {
      divided.push_back(face);
      continue;
    }
    ShapeUpgrade_ShapeDivideContinuity division(face.face);
    division.SetSurfaceCriterion(GeomAbs_C1);
    division.SetTolerance(BRep_Tool::Tolerance(face.face));
    division.Perform();
    for (TopExp_Explorer part(division.Result(), TopAbs_FACE); part.More(); part.Next()) {
      divided.push_back(face);
      divided.back().face = TopoDS::Face(part.Current());
    }
  }
  return divided;
}

JoinedPart sewn(const std::vector<LabelledFace>& faces, double tolerance) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(true);
  for (const LabelledFace& face : faces) sewing.Add(face.face);
  sewing.Perform();
  if (sewing.SewedShape().IsNull())
    throw PartError(
        fmt::format("no face is left after edges within {:.3g} mm were joined; make tolerance smaller", tolerance));
  JoinedPart part = labelled(sewing.SewedShape(), faces, [&](const TopoDS_Face& old, const auto& visit) {
    visit(sewing.IsModified(old)           ? sewing.Modified(old)
          : sewing.IsModifiedSubShape(old) ? sewing.ModifiedSubShape(old)
                                           : TopoDS_Shape(old));
  });
  part.joined_edges = sewing.NbContigousEdges();
  return part;
}

/// Whether a point lies inside a face, away from its edges by more than the tolerance.
bool is_inside(const TopoDS_Face& face, const gp_Pnt& point, double tolerance) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  ShapeAnalysis_Surface analysis(surface);
  const gp_Pnt2d uv = analysis.ValueOfUV(point, tolerance);
  if (surface->Value(uv.X(), uv.Y()).Distance(point) > tolerance) return false;
  const BRepClass_FaceClassifier classifier(face, uv, tolerance);
  return classifier.State() == TopAbs_IN;
}

bool have_common_vertex(const TopoDS_Shape& a, const TopoDS_Shape& b) {
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(a, TopAbs_VERTEX, vertices);
  for (TopExp_Explorer vertex(b, TopAbs_VERTEX); vertex.More(); vertex.Next())
    if (vertices.Contains(vertex.Current())) return true;
  return false;
}

/// Number of pairs of faces that meet and have no vertex in common: they cross, or touch inside of an edge.
int crossings(const JoinedPart& part, double tolerance) {
  std::vector<Bnd_Box> boxes(static_cast<std::size_t>(part.faces.Extent()));
  for (int f = 1; f <= part.faces.Extent(); ++f) {
    BRepBndLib::Add(part.faces(f), boxes[f - 1]);
    boxes[f - 1].Enlarge(tolerance);
  }
  int found = 0;
  for (int f = 1; f <= part.faces.Extent(); ++f)
    for (int g = f + 1; g <= part.faces.Extent(); ++g) {
      if (boxes[f - 1].IsOut(boxes[g - 1]) || have_common_vertex(part.faces(f), part.faces(g))) continue;
      const BRepExtrema_DistShapeShape distance(part.faces(f), part.faces(g));
      if (distance.IsDone() && distance.Value() <= tolerance) ++found;
    }
  return found;
}

/// Number of free edges that run inside a face or end there.
int open_joints(const JoinedPart& part, double tolerance) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(part.shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  std::vector<Bnd_Box> boxes(static_cast<std::size_t>(part.faces.Extent()));
  for (int f = 1; f <= part.faces.Extent(); ++f) {
    BRepBndLib::Add(part.faces(f), boxes[f - 1]);
    boxes[f - 1].Enlarge(tolerance);
  }
  int found = 0;
  for (int e = 1; e <= faces_of.Extent(); ++e) {
    const TopoDS_Edge edge = TopoDS::Edge(faces_of.FindKey(e));
    if (faces_of(e).Extent() != 1 || BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    const auto touches = [&](int f) {
      if (faces_of(e).First().IsSame(part.faces(f))) return false;
      constexpr int points = 8;
      for (int k = 0; k <= points; ++k) {
        const double t = curve.FirstParameter() + (curve.LastParameter() - curve.FirstParameter()) * k / points;
        const gp_Pnt point = curve.Value(t);
        if (!boxes[f - 1].IsOut(point) && is_inside(TopoDS::Face(part.faces(f)), point, tolerance)) return true;
      }
      return false;
    };
    for (int f = 1; f <= part.faces.Extent(); ++f)
      if (touches(f)) {
        ++found;
        break;
      }
  }
  return found;
}

JoinedPart imprinted(const JoinedPart& part, double tolerance) {
  BOPAlgo_Builder builder;
  for (const LabelledFace& face : part.labelled) builder.AddArgument(face.face);
  builder.SetFuzzyValue(tolerance);
  builder.SetRunParallel(false);
  builder.Perform();
  if (builder.HasErrors())
    throw PartError(
        "edges end inside of faces, and Open CASCADE cannot divide the faces there; let the faces share edges in the "
        "CAD "
        "program (imprint)");
  return labelled(builder.Shape(), part.labelled, [&](const TopoDS_Face& old, const auto& visit) {
    const TopTools_ListOfShape& now = builder.Modified(old);
    if (now.IsEmpty()) visit(TopoDS_Shape(old));
    for (const TopoDS_Shape& face : now) visit(face);
  });
}

}  // namespace

JoinedPart joined(const PartFile& part, std::optional<double> tolerance) {
  constexpr double relative = 1e-6;  // of the diagonal
  constexpr double most = 0.01;
  const TopoDS_Compound all = compound_of(part.faces);
  const double diagonal = diagonal_of(all), used = tolerance.value_or(relative * diagonal);
  if (used > most * diagonal)
    throw PartError(fmt::format("the tolerance of {:.4g} mm is above a hundredth of the part's diagonal of {:.4g} mm",
                                used, diagonal));
  JoinedPart result = sewn(divided_at_kinks(part.faces), used);
  const int joints = open_joints(result, used) + crossings(result, used);
  if (joints > 0) {
    const int joined_edges = result.joined_edges;
    result = imprinted(result, used);
    result.joined_edges = joined_edges;
  }
  result.imprinted = joints;
  result.lost_area = std::max(0.0, area_of(all) - area_of(result.shape));
  result.tolerance = used;
  return result;
}

}  // namespace plastron::cad
