// Tables of the parts of a result that belong to a place: supports, bodies, obstacles, contact zones, layers.
#include <plastron/io/quantities.hpp>

namespace plastron::io {

std::span<const Quantity<recovery::SingularPlace>> singular_place_quantities() {
  using recovery::SingularPlace;
  static const std::vector<Quantity<SingularPlace>> all{
      {"what", "-", "cause, in words", [](const SingularPlace& p) { return Json(p.what); }, Form::text},
      {"at", "the chart's", "parameters of the place in Omega", [](const SingularPlace& p) { return pair(p.at); },
       Form::pair},
      {"position", "m", "position on the undeformed mid-surface",
       [](const SingularPlace& p) { return triple(p.position); }, Form::triple},
      {"radius", "m", "stresses within this distance do not count for stress.max_von_mises",
       [](const SingularPlace& p) { return number(p.radius); }},
  };
  return all;
}

std::span<const Quantity<recovery::LayerStress>> layer_quantities() {
  using recovery::LayerStress;
  static const std::vector<Quantity<LayerStress>> all{
      {"region", "-", "name of the region", [](const LayerStress& s) { return Json(s.region); }, Form::text},
      {"layer", "1", "number of the layer, from 1 at the lower face",
       [](const LayerStress& s) { return Json(s.layer); }, Form::integer},
      {"angle", "degrees", "angle from the laminate's axis 1 to the layer's axis 1",
       [](const LayerStress& s) { return number(s.angle); }},
      {"component", "-", "11, 22, 12, 13 or 23 in the layer's axes 1, 2 and the normal 3",
       [](const LayerStress& s) { return Json(s.component); }, Form::text},
      {"max/stress", "Pa", "largest value of the component at points of output, away from singular_places",
       [](const LayerStress& s) { return number(s.most.stress); }},
      {"max/position", "m", "place of the largest value on the undeformed mid-surface",
       [](const LayerStress& s) { return triple(s.most.position); }, Form::triple},
      {"max/height", "m", "height z of the largest value, along a_3",
       [](const LayerStress& s) { return number(s.most.height); }},
      {"min/stress", "Pa", "smallest value of the component",
       [](const LayerStress& s) { return number(s.least.stress); }},
      {"min/position", "m", "place of the smallest value",
       [](const LayerStress& s) { return triple(s.least.position); }, Form::triple},
      {"min/height", "m", "height z of the smallest value",
       [](const LayerStress& s) { return number(s.least.height); }},
  };
  return all;
}

std::span<const Quantity<solution::SupportReaction>> support_quantities() {
  using solution::SupportReaction;
  static const std::vector<Quantity<SupportReaction>> all{
      {"boundary", "-", "name of the boundary", [](const SupportReaction& r) { return Json(r.boundary); }, Form::text},
      {"reaction/force", "N",
       "force of the supports on the shell along the boundary, without the forces at its corners (corner_supports)",
       [](const SupportReaction& r) { return triple(r.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "moment of the reaction about moment_point",
       [](const SupportReaction& r) { return triple(r.reaction.moment); }, Form::triple},
      {"nodes", "1", "supported nodes", [](const SupportReaction& r) { return Json(r.nodes); }, Form::integer},
  };
  return all;
}

std::span<const Quantity<solution::CornerReaction>> corner_support_quantities() {
  using solution::CornerReaction;
  static const std::vector<Quantity<CornerReaction>> all{
      {"boundaries", "-", "names of the boundaries that meet at the corner",
       [](const CornerReaction& r) {
         std::string names;
         for (const std::string& name : r.boundaries) names += (names.empty() ? "" : ", ") + name;
         return Json(names);
       },
       Form::text},
      {"at", "the chart's", "parameters of the corner in Omega", [](const CornerReaction& r) { return pair(r.at); },
       Form::pair},
      {"position", "m", "position of the corner on the undeformed mid-surface",
       [](const CornerReaction& r) { return triple(r.position); }, Form::triple},
      {"reaction/force", "N",
       "force of the supports within two thicknesses of the corner beyond the line reactions of its edges, in "
       "directions that several edges fix",
       [](const CornerReaction& r) { return triple(r.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "moment of the reaction about moment_point",
       [](const CornerReaction& r) { return triple(r.reaction.moment); }, Form::triple},
  };
  return all;
}

std::span<const Quantity<solution::PointReaction>> point_support_quantities() {
  using solution::PointReaction;
  static const std::vector<Quantity<PointReaction>> all{
      {"at", "the chart's", "parameters of the point in Omega", [](const PointReaction& r) { return pair(r.at); },
       Form::pair},
      {"position", "m", "place of the point", [](const PointReaction& r) { return triple(r.position); }, Form::triple},
      {"force", "N",
       "force of the support in directions that no boundary through the point fixes; a force that is not zero depends "
       "on the mesh",
       [](const PointReaction& r) { return triple(r.force); }, Form::triple},
  };
  return all;
}

std::span<const Quantity<solution::BodyReaction>> rigid_body_quantities() {
  using solution::BodyReaction;
  static const std::vector<Quantity<BodyReaction>> all{
      {"name", "-", "name of the body", [](const BodyReaction& b) { return Json(b.name); }, Form::text},
      {"reference", "m", "reference point before the motion", [](const BodyReaction& b) { return triple(b.reference); },
       Form::triple},
      {"displacement", "m", "displacement d of the reference point",
       [](const BodyReaction& b) { return triple(b.displacement); }, Form::triple},
      {"rotation", "rad", "rotation theta of the body: axis times angle",
       [](const BodyReaction& b) { return triple(b.rotation); }, Form::triple},
      {"reaction/force", "N", "reaction of the fixed components of the body; part of support_reaction",
       [](const BodyReaction& b) { return triple(b.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "moment of the reaction about the origin",
       [](const BodyReaction& b) { return triple(b.reaction.moment); }, Form::triple},
      {"moment_at_reference", "N m", "moment of the reaction about the reference point",
       [](const BodyReaction& b) { return triple(b.moment_at_reference); }, Form::triple},
      {"least_gap", "m", "smallest gap at nodes of the body, which have no contact constraints; null without obstacle",
       [](const BodyReaction& b) { return number(b.least_gap); }},
  };
  return all;
}

std::span<const Quantity<solution::FoundationReaction>> foundation_quantities() {
  using solution::FoundationReaction;
  static const std::vector<Quantity<FoundationReaction>> all{
      {"name", "-", "name of the foundation or spring", [](const FoundationReaction& f) { return Json(f.name); },
       Form::text},
      {"reaction/force", "N", "its resultant force on the shell",
       [](const FoundationReaction& f) { return triple(f.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "its resultant moment on the shell about moment_point",
       [](const FoundationReaction& f) { return triple(f.reaction.moment); }, Form::triple},
      {"energy", "J", "its stored energy, a part of energy_parts/foundations",
       [](const FoundationReaction& f) { return number(f.energy); }},
  };
  return all;
}

std::span<const Quantity<solution::ObstacleContact>> obstacle_quantities() {
  using solution::ObstacleContact;
  static const std::vector<Quantity<ObstacleContact>> all{
      {"name", "-", "name of the obstacle", [](const ObstacleContact& o) { return Json(o.name); }, Form::text},
      {"reaction/force", "N", "resultant force of the obstacle on the shell",
       [](const ObstacleContact& o) { return triple(o.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "resultant moment of the obstacle on the shell about moment_point",
       [](const ObstacleContact& o) { return triple(o.reaction.moment); }, Form::triple},
      {"area", "m^2", "mid-surface area within the boundaries of its contact zones",
       [](const ObstacleContact& o) { return number(o.area); }},
      {"nodes", "1", "touching nodes", [](const ObstacleContact& o) { return Json(o.nodes); }, Form::integer},
      {"bed_energy", "J", "energy of its bed; 0 where it is rigid",
       [](const ObstacleContact& o) { return number(o.bed_energy); }},
      {"bed_closure", "m", "largest distance by which its bed gives",
       [](const ObstacleContact& o) { return number(o.largest_closure); }},
      {"translation", "m", "translation since the start",
       [](const ObstacleContact& o) { return triple(o.translation); }, Form::triple},
      {"rotation", "rad", "rotation since the start: direction of the axis times the angle",
       [](const ObstacleContact& o) { return triple(o.rotation); }, Form::triple},
  };
  return all;
}

std::span<const Quantity<solution::ContactZone>> zone_quantities() {
  using solution::ContactZone;
  static const std::vector<Quantity<ContactZone>> all{
      {"area", "m^2", "mid-surface area within the boundary of the zone",
       [](const ContactZone& z) { return number(z.area); }},
      {"nodes", "1", "touching nodes", [](const ContactZone& z) { return Json(z.nodes); }, Form::integer},
      {"reaction/force", "N", "resultant force of the obstacle on the zone",
       [](const ContactZone& z) { return triple(z.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "resultant moment of the obstacle on the zone about moment_point",
       [](const ContactZone& z) { return triple(z.reaction.moment); }, Form::triple},
      {"centre_of_pressure", "m", "mean place of the reaction on the touching face of the undeformed shell",
       [](const ContactZone& z) { return triple(z.centre); }, Form::triple},
      {"is_line", "-",
       "true if the zone is a line or a point, narrower than the distance of nodes; pressures at its nodes then depend "
       "on the mesh",
       [](const ContactZone& z) { return Json(z.is_line()); }, Form::flag},
      {"line_reaction", "N/m",
       "force of the zone over half the length of its boundary; it converges if the zone is a line",
       [](const ContactZone& z) { return number(z.line_reaction()); }},
      {"peak/pressure", "Pa",
       "largest eta at a node; it depends on the mesh if the zone is a line or if an edge carries a line reaction",
       [](const ContactZone& z) { return number(z.peak_pressure); }},
      {"peak/x", "the chart's", "parameters in Omega of the node with the largest eta",
       [](const ContactZone& z) { return pair(z.peak_x); }, Form::pair},
      {"peak/position", "m", "place of the node with the largest eta on the touching face of the undeformed shell",
       [](const ContactZone& z) { return triple(z.peak_place); }, Form::triple},
      {"boundary/lines", "1", "polylines of the boundary, see contact-boundary.csv",
       [](const ContactZone& z) { return Json(z.lines.size()); }, Form::integer},
      {"boundary/points", "1", "points of the polylines of the boundary",
       [](const ContactZone& z) { return Json(z.line_points()); }, Form::integer},
      {"boundary/length", "m", "length of the boundary inside the shell, where the gap opens",
       [](const ContactZone& z) { return number(z.line_length()); }},
      {"boundary/rim_length", "m", "length of the shell's rim in the zone",
       [](const ContactZone& z) { return number(z.rim_length()); }},
  };
  return all;
}

}  // namespace plastron::io
