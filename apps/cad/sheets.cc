#include "sheets.hpp"

#include "face_surface.hpp"
#include "ribs.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepTools.hxx>
#include <IntCurvesFace_ShapeIntersector.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Lin.hxx>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

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

/// The faces behind a face, along its inward normal.
struct Opposite {
  double distance = 0;    ///< of most places; 0: there is no face at one distance
  std::set<int> faces{};  ///< there
  double share = 0;       ///< of the places that have this distance
};

/// An edge at which a face of a sheet ends on another sheet, or on a fillet between both.
struct Joint {
  int face;          ///< that ends there
  TopoDS_Edge edge;  ///< with its orientation in the face
  int target;        ///< a face of the other sheet
};

/// Two sides whose faces lie opposite to each other.
struct Sheet {
  std::vector<int> faces;  ///< of the side that is meshed
  double thickness = 0;
  bool is_whole = true;  ///< whether no other sheet interrupts this side
};

struct Sheets {
  std::vector<Sheet> all{};
  std::map<int, int> of_side{};  ///< 2 sheet, or 2 sheet + 1 for the other side
};

/// The faces of one solid.
class Solid {
 public:
  explicit Solid(std::vector<LabelledFace> faces, const TopoDS_Shape& shape) : faces_(std::move(faces)) {
    intersector_.Load(shape, 1e-7);
    TopExp::MapShapes(shape, TopAbs_FACE, map_);
    for (std::size_t i = 0; i < faces_.size(); ++i) index_[map_.FindIndex(faces_[i].face)] = static_cast<int>(i);
    for (const LabelledFace& face : faces_) opposite_.push_back(behind(face.face));
    for (std::size_t i = 0; i < faces_.size(); ++i)  // places of a large face miss a narrow one
      for (const int other : opposite_[i].faces)
        if (std::abs(opposite_[other].distance - opposite_[i].distance) <= same * opposite_[i].distance)
          opposite_[other].faces.insert(static_cast<int>(i));
    size_ = diagonal_of(shape);
    find_neighbours(shape);
    find_skins();
    find_joints();
    find_sides();
  }

  bool is_thin() const { return std::ranges::count(is_skin_, true) > 0; }

  /// The faces that are meshed, with their thickness. Throws PartError.
  SheetSides sides() const {
    const Sheets sheets = this->sheets();
    check_rims();
    check_thickness(sheets);
    SheetSides result;
    for (const Sheet& sheet : sheets.all)
      for (const int i : sheet.faces) {
        LabelledFace face = faces_[i];
        face.thickness = sheet.thickness;
        if (sheet.is_whole && (sheets.all.size() == 1 || !is_plane(sheet)))
          face.to_middle = sheet.thickness / 2;
        else
          extend(i, sheets, face, result);
        result.faces.push_back(std::move(face));
      }
    return result;
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
    // Neighbours with the same distance, such as fillets.
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const Neighbours& n : neighbours_)
        for (const auto& [known, other] : {std::pair(n.a, n.b), std::pair(n.b, n.a)})
          if (is_skin_[known] && !is_skin_[other] && opposite_[other].distance > 0 &&
              std::abs(opposite_[other].distance - opposite_[known].distance) <= same * opposite_[known].distance) {
            is_skin_[other] = true;
            is_changed = true;
          }
    }
  }

  struct Neighbours {
    int a, b;
    TopoDS_Edge edge;
  };

  void find_neighbours(const TopoDS_Shape& shape) {
    TopTools_IndexedDataMapOfShapeListOfShape faces_of;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
    for (int e = 1; e <= faces_of.Extent(); ++e) {
      std::vector<int> there;
      for (const TopoDS_Shape& face : faces_of(e))
        if (const auto found = index_.find(map_.FindIndex(face)); found != index_.end()) there.push_back(found->second);
      for (std::size_t k = 1; k < there.size(); ++k)
        if (there[0] != there[k]) neighbours_.push_back({there[0], there[k], TopoDS::Edge(faces_of.FindKey(e))});
    }
  }

  bool are_neighbours(int a, int b) const {
    return std::ranges::any_of(neighbours_,
                               [&](const Neighbours& n) { return (n.a == a && n.b == b) || (n.a == b && n.b == a); });
  }

  /// Whether two neighbours are one side of one sheet: the faces opposite to them are one, or neighbours, too.
  bool go_on(int a, int b) const {
    return std::ranges::any_of(opposite_[a].faces, [&](int behind_a) {
      return std::ranges::any_of(
          opposite_[b].faces, [&](int behind_b) { return behind_a == behind_b || are_neighbours(behind_a, behind_b); });
    });
  }

  /// An edge with its orientation in a face.
  TopoDS_Edge oriented(const TopoDS_Edge& edge, int face) const {
    for (TopExp_Explorer own(faces_[face].face, TopAbs_EDGE); own.More(); own.Next())
      if (own.Current().IsSame(edge)) return TopoDS::Edge(own.Current());
    return edge;
  }

  /// Finds the edges at which sheets meet: edges of two skins that do not go on, and fillets between such skins.
  void find_joints() {
    const auto add = [&](int face, const TopoDS_Edge& edge, int target) {
      joints_.push_back({face, oriented(edge, face), target});
    };
    for (const Neighbours& n : neighbours_)
      if (is_skin_[n.a] && is_skin_[n.b] && !go_on(n.a, n.b)) {
        add(n.a, n.edge, n.b);
        add(n.b, n.edge, n.a);
      }
    is_fillet_.assign(faces_.size(), false);
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
      if (is_skin_[f]) continue;
      std::vector<std::pair<int, TopoDS_Edge>> smooth;  // neighbours without a fold
      for (const Neighbours& n : neighbours_)
        if (const int other = n.a == f ? n.b : n.b == f ? n.a : -1; other >= 0 && is_skin_[other] && is_smooth(n))
          smooth.emplace_back(other, n.edge);
      if (smooth.size() != 2 || smooth[0].first == smooth[1].first || go_on(smooth[0].first, smooth[1].first)) continue;
      is_fillet_[f] = true;
      add(smooth[0].first, smooth[0].second, smooth[1].first);
      add(smooth[1].first, smooth[1].second, smooth[0].first);
    }
  }

  /// Whether the normals of two faces agree in the middle of their edge.
  bool is_smooth(const Neighbours& n) const {
    constexpr double smooth = 0.999;
    const BRepAdaptor_Curve curve(n.edge);
    const gp_Pnt middle = curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2);
    const auto normal = [&](int face) {
      return FaceSurface(faces_[face].face).nearest(vector_of(middle)).normal.value_or(Vector3d::Zero());
    };
    return normal(n.a).dot(normal(n.b)) > smooth;
  }

  /// Joins skins that go on across their edges to sides.
  void find_sides() {
    side_.resize(faces_.size());
    std::iota(side_.begin(), side_.end(), 0);
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const Neighbours& n : neighbours_)
        if (is_skin_[n.a] && is_skin_[n.b] && side_[n.a] != side_[n.b] && go_on(n.a, n.b)) {
          side_[n.a] = side_[n.b] = std::min(side_[n.a], side_[n.b]);
          is_changed = true;
        }
    }
  }

  [[noreturn]] static void throw_no_sheet() {
    throw PartError(
        "a solid is thin in places, but it does not consist of sheets: it branches where no plane sheet ends on "
        "another one, or is thick elsewhere; choose the faces of the shell: faces = [...] with offset = 0.5, export "
        "the "
        "mid-surface from the CAD program, or take the skin: solids = \"faces\"");
  }

  /// Finds the sheets, and for each the side that is meshed. Throws PartError.
  Sheets sheets() const {
    std::map<int, std::set<int>> partners;  // of sides
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (is_skin_[i]) {
        partners[side_[i]];
        for (const int other : opposite_[i].faces)
          if (is_skin_[other]) {
            partners[side_[i]].insert(side_[other]);
            partners[side_[other]].insert(side_[i]);
          }
      }
    Sheets sheets;
    auto& [all, colour] = sheets;
    for (const auto& [first, unused] : partners) {
      if (colour.contains(first)) continue;
      const int own = 2 * static_cast<int>(all.size());
      std::vector<int> reached{first};
      colour[first] = own;
      for (std::size_t k = 0; k < reached.size(); ++k)
        for (const int other : partners[reached[k]]) {
          if (const auto known = colour.find(other); known != colour.end()) {
            if (known->second == colour[reached[k]]) throw_no_sheet();
            continue;
          }
          colour[other] = own + (colour[reached[k]] == own ? 1 : 0);
          reached.push_back(other);
        }
      if (reached.size() < 2) throw_no_sheet();
      all.push_back(better_side(colour, own));
    }
    check_connected(colour, all);
    return sheets;
  }

  void check_thickness(const Sheets& sheets) const {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (!is_skin_[i]) continue;
      const double thickness = sheets.all[sheets.of_side.at(side_[i]) / 2].thickness;
      if (std::abs(opposite_[i].distance - thickness) > same * thickness)
        throw PartError(
            fmt::format("face {} has the thickness {:.6g} mm and other faces of its sheet {:.6g} mm; a sheet has one "
                        "thickness: choose the faces: faces = [...]",
                        faces_[i].number, opposite_[i].distance, thickness));
    }
  }

  /// The side of a sheet that fewer sheets interrupt, that has fewer pieces, or that is larger.
  Sheet better_side(const std::map<int, int>& colour, int first) const {
    Sheet best;
    std::tuple<std::size_t, std::size_t, double> least;
    for (const int own : {first, first + 1}) {
      Sheet sheet;
      std::set<int> pieces;
      double area = 0;
      for (std::size_t i = 0; i < faces_.size(); ++i)
        if (const auto found = colour.find(side_[i]); is_skin_[i] && found != colour.end() && found->second == own) {
          sheet.faces.push_back(static_cast<int>(i));
          pieces.insert(side_[i]);
          area += area_of(faces_[i].face);
        }
      const auto joints = static_cast<std::size_t>(std::ranges::count_if(joints_, [&](const Joint& joint) {
        return std::ranges::find(sheet.faces, joint.face) != sheet.faces.end();
      }));
      sheet.is_whole = joints == 0;
      sheet.thickness = opposite_[sheet.faces.front()].distance;
      if (const std::tuple now(joints, pieces.size(), -area); best.faces.empty() || now < least) {
        least = now;
        best = std::move(sheet);
      }
    }
    return best;
  }

  /// Sheets must hang together by joints, at each of which one of them is extended.
  void check_connected(const std::map<int, int>& colour, const std::vector<Sheet>& sheets) const {
    const auto sheet_of = [&](int face) { return colour.at(side_[face]) / 2; };
    std::vector<int> group(sheets.size());
    std::iota(group.begin(), group.end(), 0);
    for (const Joint& joint : joints_) {
      const int own = sheet_of(joint.face), other = sheet_of(joint.target);
      const auto extends = [&](int sheet, int target) {
        return std::ranges::any_of(joints_, [&](const Joint& j) {
          return sheet_of(j.target) == target &&
                 std::ranges::find(sheets[sheet].faces, j.face) != sheets[sheet].faces.end();
        });
      };
      if (own == other) throw_no_sheet();
      const bool is_covered =
          !(sheets[own].is_whole || sheets[other].is_whole) || extends(own, other) || extends(other, own);
      if (!is_covered) throw_no_sheet();
      const int from = std::max(group[own], group[other]), to = std::min(group[own], group[other]);
      std::ranges::replace(group, from, to);
    }
    if (std::ranges::any_of(group, [](int g) { return g != 0; })) throw_no_sheet();
  }

  const Sheet& sheet_at(int face, const Sheets& sheets) const { return sheets.all[sheets.of_side.at(side_[face]) / 2]; }

  /// The face of the meshed side at a face of either side.
  int meshed_face_at(int face, const Sheet& sheet) const {
    const auto is_meshed = [&](int i) { return std::ranges::find(sheet.faces, i) != sheet.faces.end(); };
    if (is_meshed(face)) return face;
    const auto found = std::ranges::find_if(opposite_[face].faces, is_meshed);
    return found == opposite_[face].faces.end() ? sheet.faces.front() : *found;
  }

  /// The plane in the middle of a sheet, with a face of it.
  gp_Pln middle_of(int index, double thickness) const {
    const BRepAdaptor_Surface surface(faces_[index].face);
    if (surface.GetType() != GeomAbs_Plane)
      throw PartError(fmt::format(
          "face {} is curved, and other sheets end on it or it ends on others; only plane ribs are extended to "
          "the middle of the sheet that they meet: choose the faces of the shell: faces = [...]",
          faces_[index].number));
    gp_Pln plane = surface.Plane();
    plane.Translate(gp_vec_of(-thickness / 2 * outward_of(index)));
    return plane;
  }

  /// Whether all faces of the side are plane, so that the kernel can move them to the middle.
  bool is_plane(const Sheet& sheet) const {
    return std::ranges::all_of(
        sheet.faces, [&](int face) { return BRepAdaptor_Surface(faces_[face].face).GetType() == GeomAbs_Plane; });
  }

  Vector3d outward_of(int index) const { return places_on(faces_[index].face).front().outward; }

  /// Moves a plane face to the middle of its sheet, and extends it to the sheets on which it ends.
  void extend(int index, const Sheets& sheets, LabelledFace& face, SheetSides& result) const {
    Rib rib{.face = face.face,
            .middle = middle_of(index, face.thickness),
            .outward = outward_of(index),
            .number = face.number};
    for (const Joint& joint : joints_) {
      if (joint.face != index) continue;
      const Sheet& target = sheet_at(joint.target, sheets);
      RibEnd end{.edge = joint.edge, .borders = {}, .thickness = target.thickness};
      if (target.is_whole && !is_plane(target))
        for (const int i : target.faces) end.borders.push_back(faces_[i].face);
      else
        end.borders.push_back(BRepBuilderAPI_MakeFace(middle_of(meshed_face_at(joint.target, target), target.thickness),
                                                      -size_, size_, -size_, size_));
      // Where both sheets are interrupted, each fills a part of the other's gap.
      result.overlap += length_of(joint.edge) * face.thickness * target.thickness / (target.is_whole ? 2 : 4);
      rib.ends.push_back(std::move(end));
      ++result.joints;
    }
    const Sheet& own = sheet_at(index, sheets);
    for (const Neighbours& n : neighbours_) {
      const int other = n.a == index ? n.b : n.b == index ? n.a : -1;
      if (other < 0 || std::ranges::find(own.faces, other) == own.faces.end() || is_smooth(n)) continue;
      rib.bends.push_back({.edge = oriented(n.edge, index), .other_middle = middle_of(other, face.thickness)});
    }
    face.face = extended(rib, face.thickness, size_);
  }

  /// Faces that are no skin are rims: strips as wide as the sheet is thick.
  void check_rims() const {
    double thickness = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (is_skin_[i]) thickness = std::max(thickness, opposite_[i].distance);
    std::vector<std::string> wide;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (is_skin_[i] || is_fillet_[i]) continue;
      constexpr double allowed = 1.5;
      if (area_of(faces_[i].face) > allowed * thickness * length_of(faces_[i].face) / 2)
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
  double size_ = 0;  ///< diagonal [mm]
  std::vector<Neighbours> neighbours_{};
  std::vector<bool> is_skin_{};
  std::vector<bool> is_fillet_{};  ///< between skins of two sheets
  std::vector<Joint> joints_{};
  std::vector<int> side_{};  ///< of a skin: equal on connected skins of one sheet
};

}  // namespace

SheetSides with_sides_of_sheets(const PartFile& part) {
  SheetSides chosen;
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
    const SheetSides own_sides = solid.sides();
    std::ranges::copy(own_sides.faces, std::back_inserter(chosen.faces));
    chosen.joints += own_sides.joints;
    chosen.overlap += own_sides.overlap;
  }
  if (thin == 0) return {.faces = part.faces};
  if (thin < part.solids.size())
    throw PartError(fmt::format(
        "{} of its {} solids are sheets, and the others are not; choose the faces of the shell: faces = [...], "
        "or export the sheets alone",
        thin, part.solids.size()));
  for (const LabelledFace& face : part.faces)
    if (!in_solids.Contains(face.face)) chosen.faces.push_back(face);
  return chosen;
}

}  // namespace plastron::cad
