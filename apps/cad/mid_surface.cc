#include "mid_surface.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <IntCurvesFace_ShapeIntersector.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Lin.hxx>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

namespace plastron::cad {

namespace {

struct PointOnFace {
  Vector3d position, outward;
};

/// Places inside a face with its outward normals.
std::vector<PointOnFace> places_on(const TopoDS_Face& face) {
  constexpr int steps = 7;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const BRepAdaptor_Surface surface(face, false);
  std::vector<PointOnFace> places;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double u = u0 + (u1 - u0) * (i + 0.5) / steps, v = v0 + (v1 - v0) * (j + 0.5) / steps;
      if (BRepClass_FaceClassifier(face, gp_Pnt2d(u, v), 1e-9).State() != TopAbs_IN) continue;
      gp_Pnt p;
      gp_Vec du, dv;
      surface.D1(u, v, p, du, dv);
      const Vector3d normal = vector_of(du).cross(vector_of(dv));
      if (!(normal.norm() > 0)) continue;
      places.push_back({vector_of(p), (face.Orientation() == TopAbs_REVERSED ? -1 : 1) * normal.normalized()});
    }
  return places;
}

Vector3d outward_at(const TopoDS_Face& face, double u, double v) {
  gp_Pnt p;
  gp_Vec du, dv;
  BRepAdaptor_Surface(face, false).D1(u, v, p, du, dv);
  return (face.Orientation() == TopAbs_REVERSED ? -1 : 1) * vector_of(du).cross(vector_of(dv)).normalized();
}

double perimeter_of(const TopoDS_Face& face) {
  GProp_GProps properties;
  BRepGProp::LinearProperties(face, properties);
  return properties.Mass();
}

/// The faces behind a face, along its inward normal.
struct Opposite {
  double distance = 0;    ///< of most places; 0: there is no face at one distance
  std::set<int> faces{};  ///< there
  double share = 0;       ///< of the places that have this distance
};

/// The faces of one solid.
class Solid {
 public:
  explicit Solid(std::vector<LabelledFace> faces, const TopoDS_Shape& shape) : faces_(std::move(faces)) {
    intersector_.Load(shape, 1e-7);
    TopExp::MapShapes(shape, TopAbs_FACE, map_);
    for (std::size_t i = 0; i < faces_.size(); ++i) index_[map_.FindIndex(faces_[i].face)] = static_cast<int>(i);
    for (const LabelledFace& face : faces_) opposite_.push_back(behind(face.face));
    find_skins();
    connect(shape);
  }

  bool is_thin() const { return std::ranges::count(is_skin_, true) > 0; }

  /// The side that is meshed, with its thickness. Throws PartError.
  std::vector<LabelledFace> side() const {
    // A side has its opposite faces on one other side.
    std::map<int, std::set<int>> partners;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (is_skin_[i])
        for (const int other : opposite_[i].faces)
          if (is_skin_[other]) partners[component_[i]].insert(component_[other]);
    if (partners.size() != 2 ||
        std::ranges::any_of(partners, [](const auto& p) { return p.second.size() != 1 || p.second.contains(p.first); }))
      throw PartError(
          "a solid is thin in places, but it is no sheet with two sides: it branches, or is thick elsewhere; choose "
          "the "
          "faces of the shell: faces = [...] with offset = 0.5, export the mid-surface from the CAD program, or take "
          "the "
          "skin: solids = \"faces\"");
    check_rims();
    std::map<int, double> areas;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (is_skin_[i]) areas[component_[i]] += area_of(faces_[i].face);
    const auto larger = std::ranges::max_element(areas, {}, [](const auto& entry) { return entry.second; })->first;
    std::vector<LabelledFace> side;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (!is_skin_[i] || component_[i] != larger) continue;
      side.push_back(faces_[i]);
      side.back().thickness = opposite_[i].distance;
      if (std::abs(side.back().thickness - side.front().thickness) > same * side.front().thickness)
        throw PartError(
            fmt::format("face {} has the thickness {:.6g} mm and its neighbours {:.6g} mm; a sheet has one thickness: "
                        "choose the faces: faces = [...]",
                        faces_[i].number, side.back().thickness, side.front().thickness));
    }
    return side;
  }

 private:
  static constexpr double same = 1e-3;  // relative difference of thicknesses that are one

  Opposite behind(const TopoDS_Face& face) {
    std::vector<std::pair<double, int>> hits;
    const auto places = places_on(face);
    for (const PointOnFace& place : places) {
      constexpr double nearest = 1e-6, farthest = 1e9, antiparallel = -0.999;
      intersector_.PerformNearest(
          gp_Lin(point_of(place.position), gp_Dir(-place.outward[0], -place.outward[1], -place.outward[2])), nearest,
          farthest);
      if (!intersector_.IsDone() || intersector_.NbPnt() == 0) continue;
      const TopoDS_Face& hit = intersector_.Face(1);
      const double distance = intersector_.WParameter(1);
      if (outward_at(hit, intersector_.UParameter(1), intersector_.VParameter(1)).dot(place.outward) > antiparallel)
        continue;
      if (const auto found = index_.find(map_.FindIndex(hit)); found != index_.end())
        hits.emplace_back(distance, found->second);
    }
    Opposite result;
    // The distance of most places: there may be a rib behind the others.
    for (const auto& [distance, unused] : hits) {
      std::set<int> faces;
      double count = 0;
      for (const auto& [other, index] : hits)
        if (std::abs(other - distance) <= same * distance) {
          ++count;
          faces.insert(index);
        }
      if (count > result.share) result = {distance, faces, count};
    }
    result.share /= static_cast<double>(std::max<std::size_t>(1, places.size()));
    return result;
  }

  /// Faces that are wide beside the distance of the faces behind them.
  void find_skins() {
    constexpr double slender = 0.3, most = 0.5;
    is_skin_.assign(faces_.size(), false);
    for (std::size_t i = 0; i < faces_.size(); ++i)  // a face that is opposite to itself goes round a bar
      is_skin_[i] = opposite_[i].share >= most && !opposite_[i].faces.contains(static_cast<int>(i)) &&
                    opposite_[i].distance < slender * std::sqrt(area_of(faces_[i].face));
  }

  /// Adds neighbours with the same distance, such as fillets, and finds the connected sides.
  void connect(const TopoDS_Shape& shape) {
    TopTools_IndexedDataMapOfShapeListOfShape faces_of;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
    std::vector<std::pair<int, int>> neighbours;
    for (int e = 1; e <= faces_of.Extent(); ++e) {
      std::vector<int> there;
      for (const TopoDS_Shape& face : faces_of(e))
        if (const auto found = index_.find(map_.FindIndex(face)); found != index_.end()) there.push_back(found->second);
      for (std::size_t k = 1; k < there.size(); ++k) neighbours.emplace_back(there[0], there[k]);
    }
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const auto& [a, b] : neighbours)
        for (const auto& [known, other] : {std::pair(a, b), std::pair(b, a)})
          if (is_skin_[known] && !is_skin_[other] && opposite_[other].distance > 0 &&
              std::abs(opposite_[other].distance - opposite_[known].distance) <= same * opposite_[known].distance) {
            is_skin_[other] = true;
            is_changed = true;
          }
    }
    component_.resize(faces_.size());
    std::iota(component_.begin(), component_.end(), 0);
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const auto& [a, b] : neighbours)
        if (is_skin_[a] && is_skin_[b] && component_[a] != component_[b]) {
          component_[a] = component_[b] = std::min(component_[a], component_[b]);
          is_changed = true;
        }
    }
  }

  /// Faces that are no skin are rims: strips as wide as the sheet is thick.
  void check_rims() const {
    double thickness = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (is_skin_[i]) thickness = std::max(thickness, opposite_[i].distance);
    std::vector<std::string> wide;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (is_skin_[i]) continue;
      constexpr double allowed = 1.5;
      if (area_of(faces_[i].face) > allowed * thickness * perimeter_of(faces_[i].face) / 2)
        wide.push_back(opposite_[i].distance > 0
                           ? fmt::format("face {} (the next face behind it is {:.4g} mm away)", faces_[i].number,
                                         opposite_[i].distance)
                           : fmt::format("face {} (no parallel face is behind it)", faces_[i].number));
    }
    constexpr std::size_t most = 5;
    if (wide.size() > most) wide.resize(most), wide.emplace_back("...");
    if (!wide.empty())
      throw PartError(
          fmt::format("a solid is {:.4g} mm thick in most places, but these faces have no opposite one: {}; "
                      "choose the faces of the shell by hand: faces = [...] with offset = 0.5",
                      thickness, fmt::join(wide, ", ")));
  }

  std::vector<LabelledFace> faces_;
  IntCurvesFace_ShapeIntersector intersector_;
  TopTools_IndexedMapOfShape map_;
  std::map<int, int> index_{};  // of a face of the map in faces_
  std::vector<Opposite> opposite_{};
  std::vector<bool> is_skin_{};
  std::vector<int> component_{};
};

}  // namespace

std::vector<LabelledFace> with_sides_of_sheets(const PartFile& part) {
  std::vector<LabelledFace> chosen;
  TopTools_IndexedMapOfShape in_solids;
  std::size_t thin = 0;
  for (const TopoDS_Shape& shape : part.solids) {
    TopTools_IndexedMapOfShape own;
    TopExp::MapShapes(shape, TopAbs_FACE, own);
    TopExp::MapShapes(shape, TopAbs_FACE, in_solids);
    std::vector<LabelledFace> faces;
    for (const LabelledFace& face : part.faces)
      if (own.Contains(face.face)) faces.push_back(face);
    const Solid solid(std::move(faces), shape);
    if (!solid.is_thin()) continue;
    ++thin;
    std::ranges::copy(solid.side(), std::back_inserter(chosen));
  }
  if (thin == 0) return part.faces;
  if (thin < part.solids.size())
    throw PartError(fmt::format(
        "{} of its {} solids are sheets, and the others are not; choose the faces of the shell: faces = [...], "
        "or export the sheets alone",
        thin, part.solids.size()));
  for (const LabelledFace& face : part.faces)
    if (!in_solids.Contains(face.face)) chosen.push_back(face);
  return chosen;
}

namespace {

/// The middle of a cell of each face must lie in a solid.
void check_inside(const PartFile& part, const JoinedPart& joined, const SampledMesh& mesh) {
  std::set<int> seen;
  for (const topology::SurfaceCell& cell : mesh.surface.cells) {
    const LabelledFace& face = joined.labelled[static_cast<std::size_t>(cell.region) - 1];
    if (face.thickness == 0 || !seen.insert(cell.region).second) continue;
    Vector3d middle = Vector3d::Zero();
    for (const int corner : topology::corner_nodes(mesh::Shape::quadrilateral, cell))
      middle += mesh.surface.nodes[corner] / 4;
    const bool is_inside = std::ranges::any_of(part.solids, [&](const TopoDS_Shape& solid) {
      return BRepClass3d_SolidClassifier(solid, point_of(middle), 1e-9).State() == TopAbs_IN;
    });
    if (!is_inside)
      throw PartError(
          fmt::format("the middle of the sheet at face {} is outside of the solid, which is damaged or turned "
                      "inside out; choose the faces of the shell: faces = [...]",
                      face.number));
  }
}

}  // namespace

void move_to_middle(const PartFile& part, const JoinedPart& joined, SampledMesh& mesh) {
  if (std::ranges::none_of(joined.labelled, [](const LabelledFace& face) { return face.thickness > 0; })) return;
  struct Condition {
    Vector3d normal;
    double distance;
  };
  std::vector<std::vector<Condition>> conditions(mesh.surface.nodes.size());
  constexpr double one_normal = 1e-4;  // normals that differ by less are one
  for (const topology::SurfaceCell& cell : mesh.surface.cells)
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      auto& known = conditions[static_cast<std::size_t>(cell.nodes[k])];
      const Vector3d& n = cell.normals[k];
      if (std::ranges::none_of(known, [&](const Condition& c) { return (c.normal - n).norm() < one_normal; }))
        known.push_back({n, joined.labelled[static_cast<std::size_t>(cell.region) - 1].thickness / 2});
    }
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const auto count = static_cast<Eigen::Index>(conditions[i].size());
    if (count == 0) continue;
    Eigen::MatrixX3d normals(count, 3);
    Eigen::VectorXd distances(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      normals.row(k) = conditions[i][static_cast<std::size_t>(k)].normal;
      distances[k] = -conditions[i][static_cast<std::size_t>(k)].distance;
    }
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(1e-3);
    mesh.surface.nodes[i] += svd.solve(distances);
  }
  check_inside(part, joined, mesh);
}

}  // namespace plastron::cad
