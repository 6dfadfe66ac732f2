#include "selection.hpp"

#include <plastron/geometry/expression.hpp>

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace plastron::cad {

namespace {

using nlohmann::json;

std::string number_name(const LabelledFace& face) { return fmt::format("face {}", face.number); }

std::string edge_name(int edge) { return fmt::format("edge {}", edge); }

/// Points of an edge, its ends among them.
std::vector<gp_Pnt> points_of_edge(const TopoDS_Edge& edge) {
  constexpr int intervals = 8;
  std::vector<gp_Pnt> points;
  if (BRep_Tool::Degenerated(edge)) return points;
  const BRepAdaptor_Curve curve(edge);
  for (int k = 0; k <= intervals; ++k)
    points.push_back(
        curve.Value(curve.FirstParameter() + (curve.LastParameter() - curve.FirstParameter()) * k / intervals));
  return points;
}

std::vector<gp_Pnt> points_of(const TopoDS_Shape& shape) {
  std::vector<gp_Pnt> points;
  for (TopExp_Explorer edge(shape, TopAbs_EDGE); edge.More(); edge.Next())
    std::ranges::copy(points_of_edge(TopoDS::Edge(edge.Current())), std::back_inserter(points));
  return points;
}

/// Whether an expression of X, Y, Z, in lengths of the case with ten digits, holds at all points.
class Where {
 public:
  Where(const std::string& text, const Job& job) : mm_(job.mm()) {
    try {
      expression_ = geometry::Expression(text, job.constants);
    } catch (const geometry::ExpressionError& error) {
      throw PartError(fmt::format("where = \"{}\": {}", text, error.what()));
    }
  }
  bool operator()(const std::vector<gp_Pnt>& points) const {
    return !points.empty() && std::ranges::all_of(points, [&](const gp_Pnt& p) {
      const double negligible = 1e-10 * vector_of(p).cwiseAbs().maxCoeff();
      const auto rounded = [&](double c) {
        return std::abs(c) <= negligible ? 0 : std::stod(fmt::format("{:.10g}", c / mm_));
      };
      return expression_(geometry::Place{.X = rounded(p.X()), .Y = rounded(p.Y()), .Z = rounded(p.Z())}) != 0;
    });
  }

 private:
  double mm_;
  geometry::Expression expression_{};
};

gp_Pnt point_in(const json& at, double mm) {
  return {at[0].get<double>() * mm, at[1].get<double>() * mm, at[2].get<double>() * mm};
}

double distance_to(const gp_Pnt& point, const TopoDS_Shape& shape) {
  const BRepExtrema_DistShapeShape measured(BRepBuilderAPI_MakeVertex(point).Vertex(), shape);
  return measured.IsDone() ? measured.Value() : HUGE_VAL;
}

/// The shape nearest to a point, with its pieces, which have the same name. Throws PartError if others are as near.
std::vector<bool> nearest_of(const json& at, double mm, const std::vector<TopoDS_Shape>& shapes,
                             const std::vector<std::string>& names) {
  const gp_Pnt point = point_in(at, mm);
  std::vector<double> distances;
  distances.reserve(shapes.size());
  for (const TopoDS_Shape& shape : shapes) distances.push_back(distance_to(point, shape));
  const double least = std::ranges::min(distances), rounding = 1e-7;
  std::vector<bool> is_nearest(shapes.size());
  std::transform(distances.begin(), distances.end(), is_nearest.begin(),
                 [&](double d) { return d <= least + rounding; });
  std::set<std::string> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_nearest[i]) found.insert(names[i]);
  if (found.size() > 1)
    throw PartError(fmt::format("at = {} is as near to {}; give a place nearer to one of them", at.dump(),
                                fmt::join(found, " as to ")));
  for (std::size_t i = 0; i < names.size(); ++i) is_nearest[i] = found.contains(names[i]);
  return is_nearest;
}

/// Names of a selector that is a text or a list of texts.
std::vector<std::string> texts_of(const json& value) {
  if (value.is_string()) return {value.get<std::string>()};
  std::vector<std::string> texts;
  for (const json& text : value) texts.push_back(text.get<std::string>());
  return texts;
}

bool has_name(const LabelledFace& face, const std::string& name) {
  return name == number_name(face) || (!face.label.name.empty() && name == face.label.name);
}

std::string known_faces(const std::vector<LabelledFace>& faces) {
  constexpr std::size_t most = 12;
  std::vector<std::string> known;
  std::set<std::string> seen;
  for (const LabelledFace& face : faces) {
    const std::string& name = face.label.name.empty() ? number_name(face) : face.label.name;
    if (seen.insert(name).second && known.size() < most) known.push_back(fmt::format("\"{}\"", name));
  }
  return fmt::format("{}{}", fmt::join(known, ", "), seen.size() > known.size() ? ", ..." : "");
}

/// Which of the faces a selector finds.
std::vector<bool> select_faces(const json& selector, const std::vector<LabelledFace>& faces, const Job& job) {
  std::vector<bool> found(faces.size(), true);
  const auto keep = [&](const auto& holds) {
    for (std::size_t i = 0; i < faces.size(); ++i) found[i] = found[i] && holds(i);
  };
  const auto keep_names = [&](const json& names) {
    const auto texts = texts_of(names);
    for (const std::string& text : texts)
      if (std::ranges::none_of(faces, [&](const LabelledFace& face) { return has_name(face, text); }))
        throw PartError(fmt::format("it has no face \"{}\"; it has: {}", text, known_faces(faces)));
    keep([&](std::size_t i) {
      return std::ranges::any_of(texts, [&](const std::string& text) { return has_name(faces[i], text); });
    });
  };
  if (!selector.is_object()) {
    keep_names(selector);
    return found;
  }
  if (selector.contains("name")) keep_names(selector["name"]);
  if (selector.contains("colour")) {
    const auto colour = selector["colour"].get<std::string>();
    keep([&](std::size_t i) { return faces[i].label.colour == colour; });
  }
  if (selector.contains("where")) {
    const Where where(selector["where"].get<std::string>(), job);
    keep([&](std::size_t i) { return where(points_of(faces[i].face)); });
  }
  if (selector.contains("at")) {
    std::vector<TopoDS_Shape> shapes;
    shapes.reserve(faces.size());
    std::vector<std::string> names;
    for (const LabelledFace& face : faces) {
      shapes.push_back(face.face);
      names.push_back(number_name(face));
    }
    const auto is_nearest = nearest_of(selector["at"], job.mm(), shapes, names);
    keep([&](std::size_t i) { return is_nearest[i]; });
  }
  return found;
}

/// Edges with the faces that meet there.
class EdgeFaces {
 public:
  EdgeFaces(const JoinedPart& part, const std::vector<std::string>& regions) : part_(part), regions_(regions) {
    TopExp::MapShapesAndAncestors(part.shape, TopAbs_EDGE, TopAbs_FACE, faces_);
  }

  bool is_free(int edge) const { return faces_of(edge).size() == 1; }
  /// Whether faces of the region, or with the name, meet at the edge.
  bool touches(int edge, const std::string& name) const {
    return std::ranges::any_of(faces_of(edge), [&](int face) {
      return regions_[face - 1] == name || has_name(part_.labelled[face - 1], name);
    });
  }
  bool knows(const std::string& name) const {
    return std::ranges::find(regions_, name) != regions_.end() ||
           std::ranges::any_of(part_.labelled, [&](const LabelledFace& face) { return has_name(face, name); });
  }

 private:
  std::vector<int> faces_of(int edge) const {
    std::vector<int> numbers;
    const int i = faces_.FindIndex(part_.edges(edge));
    if (i > 0)
      for (const TopoDS_Shape& face : faces_(i)) numbers.push_back(part_.faces.FindIndex(face));
    return numbers;
  }

  const JoinedPart& part_;
  const std::vector<std::string>& regions_;
  TopTools_IndexedDataMapOfShapeListOfShape faces_;
};

std::vector<bool> select_edges(const json& selector, const JoinedPart& part, const EdgeFaces& faces, const Job& job) {
  std::vector<bool> found(static_cast<std::size_t>(part.edges.Extent()), true);
  const auto keep = [&](const auto& holds) {
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = found[i] && holds(static_cast<int>(i) + 1);
  };
  keep([&](int i) { return !BRep_Tool::Degenerated(TopoDS::Edge(part.edges(i))); });
  const auto keep_names = [&](const json& names) {
    const auto texts = texts_of(names);
    for (const std::string& text : texts) {
      bool is_known = false;
      for (int i = 1; i <= part.edges.Extent(); ++i) is_known = is_known || edge_name(i) == text;
      if (!is_known)
        throw PartError(
            fmt::format("it has no edge \"{}\"; it has \"edge 1\" to \"edge {}\"", text, part.edges.Extent()));
    }
    keep([&](int i) { return std::ranges::find(texts, edge_name(i)) != texts.end(); });
  };
  if (!selector.is_object()) {
    keep_names(selector);
    return found;
  }
  if (selector.contains("name")) keep_names(selector["name"]);
  if (selector.contains("free")) keep([&](int i) { return faces.is_free(i) == selector["free"].get<bool>(); });
  for (const char* key : {"between", "of"})
    if (selector.contains(key))
      for (const std::string& name : texts_of(selector[key])) {
        if (!faces.knows(name))
          throw PartError(fmt::format("it has no face or region \"{}\"; it has: {}", name, known_faces(part.labelled)));
        keep([&](int i) { return faces.touches(i, name); });
      }
  if (selector.contains("where")) {
    const Where where(selector["where"].get<std::string>(), job);
    keep([&](int i) { return where(points_of_edge(TopoDS::Edge(part.edges(i)))); });
  }
  if (selector.contains("at")) {
    std::vector<TopoDS_Shape> shapes;
    std::vector<std::string> names;
    for (int i = 1; i <= part.edges.Extent(); ++i) {
      shapes.push_back(part.edges(i));
      names.push_back(edge_name(i));
    }
    const auto is_nearest = nearest_of(selector["at"], job.mm(), shapes, names);
    keep([&](int i) { return is_nearest[i - 1]; });
  }
  return found;
}

}  // namespace

std::vector<LabelledFace> chosen_faces(const PartFile& part, const Job& job) {
  if (job.faces.is_null()) return part.faces;
  const auto found = select_faces(job.faces, part.faces, job);
  std::vector<LabelledFace> chosen;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) chosen.push_back(part.faces[i]);
  if (chosen.empty())
    throw PartError(fmt::format("faces = {} finds none of its {} faces; it has: {}", job.faces.dump(),
                                part.faces.size(), known_faces(part.faces)));
  return chosen;
}

PartNames names_of(const JoinedPart& part, const Job& job) {
  PartNames names;
  for (const LabelledFace& face : part.labelled)
    names.regions.push_back(face.label.name.empty() ? number_name(face) : face.label.name);
  std::vector<std::string> taken(part.labelled.size());
  for (const Selection& region : job.regions) {
    const auto found = select_faces(region.selector, part.labelled, job);
    if (std::ranges::none_of(found, [](bool is_found) { return is_found; }))
      throw PartError(
          fmt::format("the region \"{}\" finds no face; it has: {}", region.name, known_faces(part.labelled)));
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) continue;
      if (!taken[i].empty() && taken[i] != region.name)
        throw PartError(fmt::format("the regions \"{}\" and \"{}\" both have {}; a face is in one region", taken[i],
                                    region.name, number_name(part.labelled[i])));
      taken[i] = region.name;
    }
  }
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (!taken[i].empty()) names.regions[i] = taken[i];
  for (const Selection& region : job.regions)
    for (std::size_t i = 0; i < taken.size(); ++i)
      if (taken[i].empty() && names.regions[i] == region.name)
        throw PartError(
            fmt::format("the region \"{}\" has the name of another face; choose another name", region.name));
  const EdgeFaces edge_faces(part, names.regions);
  for (int i = 1; i <= part.edges.Extent(); ++i) names.boundaries.push_back({edge_name(i)});
  for (const Selection& boundary : job.boundaries) {
    const auto found = select_edges(boundary.selector, part, edge_faces, job);
    if (std::ranges::none_of(found, [](bool is_found) { return is_found; }))
      throw PartError(fmt::format("the boundary \"{}\" finds none of its {} edges; `plastron parts` lists them",
                                  boundary.name, part.edges.Extent()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool has_own_name = names.boundaries[i].front() == boundary.name;
      if (has_own_name && !found[i])
        throw PartError(
            fmt::format("the boundary \"{}\" has the name of another edge; choose another name", boundary.name));
      if (found[i] && !has_own_name) names.boundaries[i].push_back(boundary.name);
    }
  }
  return names;
}

}  // namespace plastron::cad
