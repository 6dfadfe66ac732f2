// Tables of the parts of a result that belong to a place: supports, bodies, obstacles, contact zones, layers.
#include <plastron/io/quantities.hpp>

namespace plastron::io {

std::span<const Quantity<recovery::SingularPlace>> singular_place_quantities() {
  static const std::vector<Quantity<recovery::SingularPlace>> all{
      {"what", "-", "cause, in words", [](auto& p) { return p.what; }},
      {"at", "the chart's", "parameters of the place in Omega", [](auto& p) { return p.at; }},
      {"position", "m", "position on the undeformed mid-surface", [](auto& p) { return p.position; }},
      {"radius", "m", "stresses within this distance do not count for stress.max_von_mises",
       [](auto& p) { return p.radius; }},
  };
  return all;
}

std::span<const Quantity<recovery::LayerStress>> layer_quantities() {
  static const std::vector<Quantity<recovery::LayerStress>> all{
      {"region", "-", "name of the region", [](auto& s) { return s.region; }},
      {"layer", "1", "number of the layer, from 1 at the lower face", [](auto& s) { return s.layer; }},
      {"angle", "degrees", "angle from the laminate's axis 1 to the layer's axis 1", [](auto& s) { return s.angle; }},
      {"component", "-", "11, 22, 12, 13 or 23 in the layer's axes 1, 2 and the normal 3",
       [](auto& s) { return s.component; }},
      {"max/stress", "Pa", "largest value of the component at points of output, away from singular_places",
       [](auto& s) { return s.most.stress; }},
      {"max/position", "m", "place of the largest value on the undeformed mid-surface",
       [](auto& s) { return s.most.position; }},
      {"max/height", "m", "height z of the largest value, along a_3", [](auto& s) { return s.most.height; }},
      {"min/stress", "Pa", "smallest value of the component", [](auto& s) { return s.least.stress; }},
      {"min/position", "m", "place of the smallest value", [](auto& s) { return s.least.position; }},
      {"min/height", "m", "height z of the smallest value", [](auto& s) { return s.least.height; }},
  };
  return all;
}

std::span<const Quantity<solution::SupportReaction>> support_quantities() {
  static const std::vector<Quantity<solution::SupportReaction>> all{
      {"boundary", "-", "name of the boundary", [](auto& r) { return r.boundary; }},
      {"reaction/force", "N",
       "force of the supports on the shell along the boundary, without the forces at its corners (corner_supports)",
       [](auto& r) { return r.reaction.force; }},
      {"reaction/moment", "N m", "moment of the reaction about moment_point",
       [](auto& r) { return r.reaction.moment; }},
      {"nodes", "1", "supported nodes", [](auto& r) { return r.nodes; }},
  };
  return all;
}

std::span<const Quantity<solution::CornerReaction>> corner_support_quantities() {
  static const std::vector<Quantity<solution::CornerReaction>> all{
      {"boundaries", "-", "names of the boundaries that meet at the corner",
       [](auto& r) {
         std::string names;
         for (const std::string& name : r.boundaries) names += (names.empty() ? "" : ", ") + name;
         return names;
       }},
      {"at", "the chart's", "parameters of the corner in Omega", [](auto& r) { return r.at; }},
      {"position", "m", "position of the corner on the undeformed mid-surface", [](auto& r) { return r.position; }},
      {"reaction/force", "N",
       "force of the supports within two thicknesses of the corner beyond the line reactions of its edges, in "
       "directions that several edges fix",
       [](auto& r) { return r.reaction.force; }},
      {"reaction/moment", "N m", "moment of the reaction about moment_point",
       [](auto& r) { return r.reaction.moment; }},
  };
  return all;
}

std::span<const Quantity<solution::PointReaction>> point_support_quantities() {
  static const std::vector<Quantity<solution::PointReaction>> all{
      {"at", "the chart's", "parameters of the point in Omega", [](auto& r) { return r.at; }},
      {"position", "m", "place of the point", [](auto& r) { return r.position; }},
      {"force", "N",
       "force of the support in directions that no boundary through the point fixes; a force that is not zero depends "
       "on the mesh",
       [](auto& r) { return r.force; }},
  };
  return all;
}

std::span<const Quantity<solution::BodyReaction>> rigid_body_quantities() {
  static const std::vector<Quantity<solution::BodyReaction>> all{
      {"name", "-", "name of the body", [](auto& b) { return b.name; }},
      {"reference", "m", "reference point before the motion", [](auto& b) { return b.reference; }},
      {"displacement", "m", "displacement d of the reference point", [](auto& b) { return b.displacement; }},
      {"rotation", "rad", "rotation theta of the body: axis times angle", [](auto& b) { return b.rotation; }},
      {"reaction/force", "N", "reaction of the fixed components of the body; part of support_reaction",
       [](auto& b) { return b.reaction.force; }},
      {"reaction/moment", "N m", "moment of the reaction about the origin", [](auto& b) { return b.reaction.moment; }},
      {"moment_at_reference", "N m", "moment of the reaction about the reference point",
       [](auto& b) { return b.moment_at_reference; }},
      {"least_gap", "m", "smallest gap at nodes of the body, which have no contact constraints; null without obstacle",
       [](auto& b) { return b.least_gap; }},
  };
  return all;
}

std::span<const Quantity<solution::FoundationReaction>> foundation_quantities() {
  static const std::vector<Quantity<solution::FoundationReaction>> all{
      {"name", "-", "name of the foundation or spring", [](auto& f) { return f.name; }},
      {"reaction/force", "N", "its resultant force on the shell", [](auto& f) { return f.reaction.force; }},
      {"reaction/moment", "N m", "its resultant moment on the shell about moment_point",
       [](auto& f) { return f.reaction.moment; }},
      {"energy", "J", "its stored energy, a part of energy_parts/foundations", [](auto& f) { return f.energy; }},
  };
  return all;
}

std::span<const Quantity<solution::ObstacleContact>> obstacle_quantities() {
  static const std::vector<Quantity<solution::ObstacleContact>> all{
      {"name", "-", "name of the obstacle", [](auto& o) { return o.name; }},
      {"reaction/force", "N", "resultant force of the obstacle on the shell", [](auto& o) { return o.reaction.force; }},
      {"reaction/moment", "N m", "resultant moment of the obstacle on the shell about moment_point",
       [](auto& o) { return o.reaction.moment; }},
      {"area", "m^2", "mid-surface area within the boundaries of its contact zones", [](auto& o) { return o.area; }},
      {"nodes", "1", "touching nodes", [](auto& o) { return o.nodes; }},
      {"bed_energy", "J", "energy of its bed; 0 where it is rigid", [](auto& o) { return o.bed_energy; }},
      {"bed_closure", "m", "largest distance by which its bed gives", [](auto& o) { return o.largest_closure; }},
      {"translation", "m", "translation since the start", [](auto& o) { return o.translation; }},
      {"rotation", "rad", "rotation since the start: direction of the axis times the angle",
       [](auto& o) { return o.rotation; }},
  };
  return all;
}

std::span<const Quantity<solution::ContactZone>> zone_quantities() {
  static const std::vector<Quantity<solution::ContactZone>> all{
      {"area", "m^2", "mid-surface area within the boundary of the zone", [](auto& z) { return z.area; }},
      {"nodes", "1", "touching nodes", [](auto& z) { return z.nodes; }},
      {"reaction/force", "N", "resultant force of the obstacle on the zone", [](auto& z) { return z.reaction.force; }},
      {"reaction/moment", "N m", "resultant moment of the obstacle on the zone about moment_point",
       [](auto& z) { return z.reaction.moment; }},
      {"centre_of_pressure", "m", "mean place of the reaction on the touching face of the undeformed shell",
       [](auto& z) { return z.centre; }},
      {"is_line", "-",
       "true if the zone is a line or a point, narrower than the distance of nodes; pressures at its nodes then depend "
       "on the mesh",
       [](auto& z) { return z.is_line(); }},
      {"line_reaction", "N/m",
       "force of the zone over half the length of its boundary; it converges if the zone is a line",
       [](auto& z) { return z.line_reaction(); }},
      {"peak/pressure", "Pa",
       "largest eta at a node; it depends on the mesh if the zone is a line or if an edge carries a line reaction",
       [](auto& z) { return z.peak_pressure; }},
      {"peak/x", "the chart's", "parameters in Omega of the node with the largest eta",
       [](auto& z) { return z.peak_x; }},
      {"peak/position", "m", "place of the node with the largest eta on the touching face of the undeformed shell",
       [](auto& z) { return z.peak_place; }},
      {"boundary/lines", "1", "polylines of the boundary, see contact-boundary.csv",
       [](auto& z) { return z.lines.size(); }},
      {"boundary/points", "1", "points of the polylines of the boundary", [](auto& z) { return z.line_points(); }},
      {"boundary/length", "m", "length of the boundary inside the shell, where the gap opens",
       [](auto& z) { return z.line_length(); }},
      {"boundary/rim_length", "m", "length of the shell's rim in the zone", [](auto& z) { return z.rim_length(); }},
  };
  return all;
}

}  // namespace plastron::io
