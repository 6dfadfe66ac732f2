#include "ribs.hpp"

#include "face_surface.hpp"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Builder.hxx>
#include <Geom_Curve.hxx>
#include <Geom_OffsetCurve.hxx>
#include <IntCurvesFace_ShapeIntersector.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Lin.hxx>

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

namespace plastron::cad {

namespace {

/// The plane of a rib's middle beyond one of its edges.
struct Beyond {
  Handle(Geom_Curve) curve;  ///< the edge
  double first = 0, last = 0;
  double sense = 1;  ///< -1: the face has the edge against its curve
  Vector3d outward;  ///< normal of the face
  double reach = 0;  ///< width of a strip that crosses the borders [mm]

  Beyond(const TopoDS_Edge& of_face, const Rib& rib, const gp_Trsf& move, double width)
      : outward(rib.outward), reach(width) {
    const TopoDS_Edge edge = TopoDS::Edge(BRepBuilderAPI_Transform(of_face, move, true).Shape());
    curve = BRep_Tool::Curve(edge, first, last);
    sense = edge.Orientation() == TopAbs_REVERSED ? -1 : 1;
  }

  /// Finds the reach.
  Beyond(const RibEnd& end, const Rib& rib, const gp_Trsf& move, double size) : Beyond(end.edge, rib, move, 0.0) {
    IntCurvesFace_ShapeIntersector hits;
    TopoDS_Compound all;
    const BRep_Builder builder;
    builder.MakeCompound(all);
    for (const TopoDS_Face& border : end.borders) builder.Add(all, border);
    hits.Load(all, 1e-7);
    constexpr int steps = 8;
    constexpr double margin = 0.01;  // the ends may lie on the rim of the borders
    for (int k = 0; k <= steps; ++k) {
      const double at = first + (last - first) * (margin + (1 - 2 * margin) * k / steps);
      const Vector3d d = direction(at);
      hits.PerformNearest(gp_Lin(curve->Value(at), gp_Dir(d[0], d[1], d[2])), 0, size);
      if (hits.IsDone() && hits.NbPnt() > 0) reach = std::max(reach, hits.WParameter(1));
    }
    if (reach > 0) reach += end.thickness;
  }

  /// Direction out of the face: its material lies to the left of an edge, seen against the normal.
  Vector3d direction(double at) const {
    gp_Pnt p;
    gp_Vec d;
    curve->D1(at, p, d);
    return (sense * vector_of(d)).cross(outward).normalized();
  }

  bool is_closed() const { return curve->Value(first).Distance(curve->Value(last)) < 1e-7; }

  TopoDS_Face strip(const gp_Pln& plane) const {
    const Vector3d along = sense * outward;  // Geom_OffsetCurve moves along tangent x this
    const Handle(Geom_Curve) far_curve = new Geom_OffsetCurve(curve, reach, gp_Dir(along[0], along[1], along[2]));
    const TopoDS_Edge near_edge = BRepBuilderAPI_MakeEdge(curve, first, last),
                      far_edge = BRepBuilderAPI_MakeEdge(far_curve, first, last);
    if (is_closed()) {
      const bool grows = length_of(far_edge) > length_of(near_edge);
      const TopoDS_Wire outer = BRepBuilderAPI_MakeWire(grows ? far_edge : near_edge),
                        inner = BRepBuilderAPI_MakeWire(grows ? near_edge : far_edge);
      BRepBuilderAPI_MakeFace face(plane, outer);
      face.Add(TopoDS::Wire(inner.Reversed()));
      return face.Face();
    }
    BRepBuilderAPI_MakeWire wire;
    wire.Add(near_edge);
    wire.Add(BRepBuilderAPI_MakeEdge(curve->Value(last), far_curve->Value(last)).Edge());
    wire.Add(TopoDS::Edge(far_edge.Reversed()));
    wire.Add(BRepBuilderAPI_MakeEdge(far_curve->Value(first), curve->Value(first)).Edge());
    return BRepBuilderAPI_MakeFace(plane, wire.Wire());
  }

  gp_Pnt middle() const { return curve->Value((first + last) / 2); }
};

/// The corners between two strips whose edges have a common end.
std::vector<std::pair<TopoDS_Face, gp_Pnt>> corners(const Beyond& a, const Beyond& b, const gp_Pln& plane) {
  std::vector<std::pair<TopoDS_Face, gp_Pnt>> all;
  if (a.is_closed() || b.is_closed()) return all;
  for (const double at : {a.first, a.last})
    for (const double bt : {b.first, b.last}) {
      const gp_Pnt p = a.curve->Value(at);
      const Vector3d to_a = a.reach * a.direction(at), to_b = b.reach * b.direction(bt), v = vector_of(p);
      constexpr double parallel = 0.1;
      if (p.Distance(b.curve->Value(bt)) > 1e-6 || to_a.cross(to_b).norm() < parallel * a.reach * b.reach) continue;
      BRepBuilderAPI_MakePolygon outline(p, point_of(v + to_a), point_of(v + to_a + to_b), point_of(v + to_b), true);
      all.emplace_back(BRepBuilderAPI_MakeFace(plane, outline.Wire()).Face(), p);
    }
  return all;
}

/// The piece of a face at a point, where borders divide the face; a null face if they do not.
TopoDS_Face piece_at(const gp_Pnt& point, const TopoDS_Face& face, const std::vector<TopoDS_Face>& borders) {
  if (borders.empty()) return face;
  BRepAlgoAPI_Splitter splitter;
  TopTools_ListOfShape parts, tools;
  parts.Append(face);
  for (const TopoDS_Face& border : borders) tools.Append(border);
  splitter.SetArguments(parts);
  splitter.SetTools(tools);
  splitter.SetRunParallel(false);
  splitter.Build();
  if (splitter.HasErrors()) return {};
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(point);
  int count = 0;
  TopoDS_Face found;
  for (TopExp_Explorer piece(splitter.Shape(), TopAbs_FACE); piece.More(); piece.Next(), ++count) {
    const BRepExtrema_DistShapeShape distance(vertex, piece.Current());
    if (distance.IsDone() && distance.Value() < 1e-6) found = TopoDS::Face(piece.Current());
  }
  return count > 1 ? found : TopoDS_Face();
}

/// Turns a plane face such that its normal is the given one.
TopoDS_Face turned_to(const Vector3d& normal, const TopoDS_Face& face) {
  return FaceSurface(face).nearest(Vector3d::Zero()).normal->dot(normal) > 0 ? face : TopoDS::Face(face.Reversed());
}

/// The largest part of a face that the line of a bend divides; the face itself where the line does not.
TopoDS_Face cut_at(const Beyond& bend, const gp_Pln& other, const gp_Pln& own, double beyond, const TopoDS_Face& face) {
  const Vector3d n(own.Axis().Direction().X(), own.Axis().Direction().Y(), own.Axis().Direction().Z()),
      m(other.Axis().Direction().X(), other.Axis().Direction().Y(), other.Axis().Direction().Z());
  const Vector3d along = n.cross(m).normalized(), across = along.cross(m);
  const auto on_line = [&](double at) {  // in both planes, beside a point of the edge
    const Vector3d p = vector_of(bend.curve->Value(at));
    Eigen::Matrix3d rows;
    rows << n.transpose(), m.transpose(), along.transpose();
    return Vector3d(rows.inverse() *
                    Vector3d(n.dot(vector_of(own.Location())), m.dot(vector_of(other.Location())), along.dot(p)));
  };
  Vector3d from = on_line(bend.first), to = on_line(bend.last);
  const Vector3d further = beyond * (to - from).normalized();
  from -= further;
  to += further;
  BRepBuilderAPI_MakePolygon outline(point_of(from - beyond * across), point_of(to - beyond * across),
                                     point_of(to + beyond * across), point_of(from + beyond * across), true);
  BRepAlgoAPI_Splitter splitter;
  TopTools_ListOfShape parts, tools;
  parts.Append(face);
  tools.Append(BRepBuilderAPI_MakeFace(other, outline.Wire()).Face());
  splitter.SetArguments(parts);
  splitter.SetTools(tools);
  splitter.SetRunParallel(false);
  splitter.Build();
  if (splitter.HasErrors()) return {};
  TopoDS_Face largest;
  double area = 0;
  for (TopExp_Explorer piece(splitter.Shape(), TopAbs_FACE); piece.More(); piece.Next())
    if (const double own_area = area_of(piece.Current()); own_area > area) {
      area = own_area;
      largest = TopoDS::Face(piece.Current());
    }
  return largest;
}

/// One face of faces in one plane that touch; a null face if several are left.
TopoDS_Face united(const std::vector<TopoDS_Face>& pieces) {
  if (pieces.size() == 1) return pieces.front();
  BRepAlgoAPI_Fuse fuse;
  TopTools_ListOfShape first, others;
  first.Append(pieces.front());
  for (std::size_t k = 1; k < pieces.size(); ++k) others.Append(pieces[k]);
  fuse.SetArguments(first);
  fuse.SetTools(others);
  fuse.SetRunParallel(false);
  fuse.Build();
  if (fuse.HasErrors()) return {};
  ShapeUpgrade_UnifySameDomain unify(fuse.Shape());
  unify.Build();
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(unify.Shape(), TopAbs_FACE, faces);
  return faces.Extent() == 1 ? TopoDS::Face(faces(1)) : TopoDS_Face();
}

}  // namespace

TopoDS_Face extended(const Rib& rib, double thickness, double size) {
  const auto fail = [&] {
    throw PartError(fmt::format(
        "face {} ends on another sheet, and cannot be extended to the middle of it; choose the faces of the "
        "shell: faces = [...]",
        rib.number));
  };
  gp_Trsf move;
  move.SetTranslation(gp_vec_of(-thickness / 2 * rib.outward));
  std::vector<TopoDS_Face> pieces{TopoDS::Face(BRepBuilderAPI_Transform(rib.face, move, true).Shape())};
  std::vector<Beyond> beyond;
  std::vector<std::vector<TopoDS_Face>> borders;
  double farthest = 2 * thickness;
  for (const RibEnd& end : rib.ends) {
    beyond.emplace_back(end, rib, move, size);
    borders.push_back(end.borders);
    if (!(beyond.back().reach > 0)) fail();
    farthest = std::max(farthest, beyond.back().reach);
  }
  for (const RibBend& bend : rib.bends) {  // wide enough for bends of 150 degrees
    beyond.emplace_back(bend.edge, rib, move, 2 * thickness);
    borders.emplace_back();
  }
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    pieces.push_back(piece_at(beyond[i].middle(), beyond[i].strip(rib.middle), borders[i]));
    for (std::size_t k = 0; k < i; ++k) {
      std::vector<TopoDS_Face> both = borders[i];
      std::ranges::copy(borders[k], std::back_inserter(both));
      for (const auto& [corner, point] : corners(beyond[i], beyond[k], rib.middle))
        pieces.push_back(piece_at(point, corner, both));
    }
  }
  for (TopoDS_Face& piece : pieces) {
    if (piece.IsNull()) fail();
    piece = turned_to(rib.outward, piece);
  }
  TopoDS_Face whole = united(pieces);
  for (std::size_t k = 0; k < rib.bends.size() && !whole.IsNull(); ++k)
    whole = cut_at(beyond[rib.ends.size() + k], rib.bends[k].other_middle, rib.middle, farthest, whole);
  if (whole.IsNull()) fail();
  return whole;
}

}  // namespace plastron::cad
