#include "verification/reference_problems.hpp"

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

namespace plastron::verification {

namespace {

using assembly::Direction;
using assembly::PrescribedComponent;
using assembly::Support;
using assembly::Unknown;
using geometry::Constants;
using geometry::Expression;
using nlohmann::ordered_json;

const ordered_json& reference_file() {
  static const ordered_json file = [] {
    std::ifstream stream(PLASTRON_REFERENCE_DIR "/contact.json");
    return ordered_json::parse(stream);
  }();
  return file;
}

PrescribedComponent zero(Unknown unknown, Direction direction) { return {unknown, direction, Expression(0.0)}; }

Support clamped(const std::string& boundary) {
  Support s{.boundary = boundary, .components = {}};
  for (const auto unknown : {Unknown::displacement, Unknown::rotation})
    for (const auto direction : {Direction::x, Direction::y, Direction::z})
      s.components.push_back(zero(unknown, direction));
  return s;
}

Support symmetry(const std::string& boundary) {
  return {
      .boundary = boundary,
      .components = {zero(Unknown::displacement, Direction::conormal), zero(Unknown::rotation, Direction::conormal)},
      .symmetry = true};
}

/// Keeps a strip in its plane: u.y = r.y = 0.
Support in_plane(const std::string& boundary) {
  return {.boundary = boundary,
          .components = {zero(Unknown::displacement, Direction::y), zero(Unknown::rotation, Direction::y)}};
}

energy::AreaLoad downward(double p) {
  energy::AreaLoad load{};
  load.force = {Expression(0.0), Expression(0.0), Expression(-p)};
  return load;
}

// ---- contact -------------------------------------------------------------------------------------------------------

Constants constants_of(const ordered_json& geometry) {
  Constants constants;
  for (const auto& [name, value] : geometry.items()) constants.emplace_back(name, value.get<double>());
  return constants;
}

geometry::Chart strip_chart(const std::string& profile, const Constants& c) {
  if (profile == "flat") return {{"x", "y", "z0"}, c};
  if (profile == "incline") return {{"x*cos(al)", "y", "z0 + x*sin(al)"}, c};
  if (profile == "bowl") return {{"R*sin(x)", "y", "z0 - R*cos(x)"}, c};
  throw std::logic_error("no strip of profile " + profile);
}

geometry::Chart disk_chart(const std::string& profile, const Constants& c) {
  if (profile == "flat") return {{"x", "y", "z0"}, c};
  if (profile == "bowl") return {{"x", "y", "z0 - sqrt(R^2 - x^2 - y^2)"}, c};
  if (profile == "hat") return {{"x", "y", "z0 + hh*((x^2 + y^2)/r0^2 - 1)^2"}, c};
  throw std::logic_error("no disk of profile " + profile);
}

/// Distance from the axis at the profile's parameter t.
double radius_at(const ordered_json& entry, double t) {
  return entry["profile"] == "bowl" ? entry["params"]["geometry"]["R"].get<double>() * std::sin(t) : t;
}

problem::Problem pressed_shell(const ordered_json& params) {
  problem::Problem problem;
  problem.shell.sections.common.thickness = Expression(params["e"].get<double>());
  problem.shell.sections.common.material = shell::Material::from_young_poisson(params["E"], params["nu"], params["ks"]);
  problem.shell.loads.on_areas = {downward(params["p"])};
  problem.shell.obstacles.all = {obstacle::Obstacle{}};
  return problem;
}

void make_strip(const ordered_json& entry, ContactReference& reference) {
  const auto& params = entry["params"];
  const double from = params["t0"], to = params["t1"];
  const double width = (to - from) / 8;
  problem::Problem& problem = reference.problem;
  problem.domain = domain::Rectangle{.from = {from, 0}, .to = {to, width}, .cells = {8, 1}};
  problem.charts.emplace("", strip_chart(entry["profile"], constants_of(params["geometry"])));
  problem.shell.supports = {params["bc0"] == "sym" ? symmetry("left") : clamped("left"), clamped("right"),
                            in_plane("bottom"), in_plane("top")};
  reference.factor = 1 / width;
}

void make_disk(const ordered_json& entry, ContactReference& reference) {
  problem::Problem& problem = reference.problem;
  problem.domain = domain::Disk{.radius = radius_at(entry, entry["params"]["t1"])};
  problem.charts.emplace("", disk_chart(entry["profile"], constants_of(entry["params"]["geometry"])));
  problem.shell.supports = {clamped("rim")};
}

/// Half of a strip of length 1, clamped at both ends, that p per unit of area presses down, of unit width (M11).
/// Free on s = a - x > 0, x the distance from the clamped end: Q = Q_a + p s, r'' = -Q / T with the bending stiffness T, w' = r + Q / S
/// with the shear stiffness S. Elsewhere w = clearance, so r decays like sinh k(1/2 - x) with k^2 = S / T. At a the rotation, the moment
/// and the force are continuous, and w' = 0, because no line carries a reaction.
struct PressedStrip {
  double p, T, S;

  double k() const { return std::sqrt(S / T); }
  double decay(double a) const { return k() / std::tanh(k() * (0.5 - a)); }  ///< -r' / r at a
  /// The edge of the zone, chosen so that r = 0 at the clamped end.
  double rotation(double a) const { return p * a * a * a / (6 * T) / (1 + decay(a) * a + k() * k() * a * a / 2); }
  double sag(double a) const {
    const double r = rotation(a);
    return r * a * a * (decay(a) / 2 + k() * k() * a / 6) - p * std::pow(a, 4) / (24 * T) + p * a * a / (2 * S);
  }
  /// Integral of w over the free part.
  double integral(double a) const {
    const double r = rotation(a), cube = a * a * a;
    return r * cube * (decay(a) / 3 + k() * k() * a / 8) - p * cube * a * a / (30 * T) + p * cube / (3 * S);
  }
  double force_at_end(double a) const { return p * a - S * rotation(a); }
  /// The distance from its end at which the strip begins to touch.
  double edge(double clearance) const {
    double low = 1e-6, high = 0.5 - 1e-9;
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      (sag(middle) < clearance ? low : high) = middle;
    }
    return low;
  }
};

std::vector<ReferenceRow> rows_of(const ordered_json& entry, bool axisymmetric) {
  std::map<std::string, std::size_t> column;
  for (const auto& name : entry["field_names"]) column.emplace(name.get<std::string>(), column.size());
  std::vector<ReferenceRow> rows;
  for (const auto& row : entry["fields"]) {
    const auto value = [&](const char* name) { return row[column.at(name)].get<double>(); };
    rows.push_back({.at = axisymmetric ? radius_at(entry, value("t")) : value("t"),
                    .u_x = value("ux"),
                    .u_z = value("uz"),
                    .r_x = value("r_x"),
                    .r_z = value("r_z"),
                    .gap = value("gap"),
                    .eta = value("eta"),
                    .touching = row[column.at("zone")] != "F"});
  }
  return rows;
}

// ---- linear shells -------------------------------------------------------------------------------------------------

double factor_of(ShearCorrection k) { return k == ShearCorrection::one ? 1 : 5.0 / 6; }
double pick(ShearCorrection k, double five_sixths, double one) { return k == ShearCorrection::one ? one : five_sixths; }

problem::Problem free_shell(double E, double nu, ShearCorrection k, double thickness, int degree, int refinements) {
  problem::Problem problem;
  problem.shell.sections.common.thickness = Expression(thickness);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(E, nu, factor_of(k));
  problem.discretisation = {.degree = degree, .refinements = refinements};
  return problem;
}

bool thick(double thickness, double thick_value, double thin_value) {
  if (thickness != thick_value && thickness != thin_value)
    throw std::invalid_argument(
        fmt::format("no reference for thickness {}: {} or {}", thickness, thick_value, thin_value));
  return thickness == thick_value;
}

/// The energy of the saddle clamped on one edge.
struct SaddleValues {
  double displacement, energy;
};

SaddleValues saddle_values(double thickness, ShearCorrection k) {
  if (thickness == 1e-4) return {pick(k, 0.530792, 0.530790), pick(k, 0.0900328, 0.0900325)};
  return thick(thickness, 1e-2, 1e-3)
             ? SaddleValues{pick(k, 9.3535e-5, 9.3490e-5), pick(k, 1.68250e-3, 1.68167e-3)}
             : SaddleValues{pick(k, 6.39937e-3, 6.39917e-3), pick(k, 1.102321e-2, 1.102284e-2)};
}

}  // namespace

std::vector<std::string> contact_reference_names() {
  std::vector<std::string> names;
  for (const auto& [name, entry] : reference_file().items()) names.push_back(name);
  return names;
}

std::string contact_reference_title(const std::string& name) {
  static const std::map<std::string, std::string> titles{
      {"R1_e0.1_P0.2", "R1 strip, e = 0.1, no contact"},
      {"R1_e0.1_P3", "R1 strip, e = 0.1"},
      {"R1_e0.01_P3", "R1 strip, e = 0.01"},
      {"R2bowl_e0.1_p0.02", "R2 bowl, e = 0.1"},
      {"R2bowl_e0.02_p0.0008", "R2 bowl, e = 0.02"},
      {"R2incl_al0.3_e0.1_p0.02", "R2 incline, e = 0.1"},
      {"R3_e0.1_P0.5", "R3 plate, e = 0.1"},
      {"R3_e0.01_P0.5", "R3 plate, e = 0.01"},
      {"R4cap_e0.1_p0.02", "R4 cap, e = 0.1"},
      {"R4cap_e0.02_p0.002", "R4 cap, e = 0.02"},
      {"R4hat_e0.05_p0.00125", "R4 hat, e = 0.05"},
  };
  return titles.at(name);
}

ContactReference contact_reference(const std::string& name, int degree, int refinements) {
  const ordered_json& entry = reference_file().at(name);
  ContactReference reference{.name = name, .problem = pressed_shell(entry["params"]), .pattern = entry["pattern"]};
  reference.axisymmetric = entry["kind"] == "axi";
  reference.axisymmetric ? make_disk(entry, reference) : make_strip(entry, reference);
  reference.problem.discretisation = {.degree = degree, .refinements = refinements};
  const auto& scalars = entry["scalars"];
  reference.energy = scalars["E_total"];
  reference.membrane = scalars["E_membrane"];
  reference.bending = scalars["E_bending"];
  reference.shear = scalars["E_shear"];
  reference.load_work = scalars["load_work"];
  reference.reaction = scalars["total_reaction"];
  for (const double t : entry["contact_boundaries_t"])
    reference.boundaries.push_back(reference.axisymmetric ? radius_at(entry, t) : t);
  reference.rows = rows_of(entry, reference.axisymmetric);
  return reference;
}

double contact_area(const ContactReference& reference) {
  const auto* disk = std::get_if<domain::Disk>(&reference.problem.domain);
  const auto* strip = std::get_if<domain::Rectangle>(&reference.problem.domain);
  std::vector<double> ends{disk ? 0.0 : strip->from[0]};
  ends.insert(ends.end(), reference.boundaries.begin(), reference.boundaries.end());
  ends.push_back(disk ? disk->radius : strip->to[0]);
  const auto density = [&](double at) {
    const geometry::SurfaceJet jet = reference.problem.charts.at("")(at, 0.0);
    return jet.d[0].cross(jet.d[1]).norm() * (disk ? 2 * std::numbers::pi * at : strip->to[1] - strip->from[1]);
  };
  double area = 0;
  for (std::size_t part = 0; part < reference.pattern.size(); ++part) {
    if (reference.pattern[part] != 'C') continue;
    constexpr int intervals = 500;
    const double width = (ends[part + 1] - ends[part]) / intervals;
    for (int i = 0; i < intervals; ++i) {
      const double from = ends[part] + i * width;
      area += width / 6 * (density(from) + 4 * density(from + width / 2) + density(from + width));
    }
  }
  return area;
}

ContactReference pressed_strip(double thickness, int degree, int refinements) {
  ContactReference reference = contact_reference("R1_e0.01_P3", degree, refinements);
  ordered_json entry = reference_file().at(reference.name);
  auto& params = entry["params"];
  const double E = params["E"], nu = params["nu"], clearance = params["clearance"], e = thickness;
  const PressedStrip strip{.p = 3 * std::pow(e, 3),
                           .T = E * std::pow(e, 3) / (12 * (1 - nu * nu)),
                           .S = params["ks"].get<double>() * E * e / (2 * (1 + nu))};
  params["e"] = e;
  params["p"] = strip.p;
  params["geometry"]["z0"] = clearance + e / 2;
  reference.name = fmt::format("R1_e{:g}_P3", e);
  reference.problem = pressed_shell(params);
  make_strip(entry, reference);
  reference.problem.discretisation = {.degree = degree, .refinements = refinements};
  const double a = strip.edge(clearance);
  reference.boundaries = {a, 1 - a};
  reference.load_work = 2 * strip.p * (strip.integral(a) + clearance * (0.5 - a));
  reference.reaction = strip.p - 2 * strip.force_at_end(a);
  reference.energy = (reference.load_work - reference.reaction * clearance) / 2;
  reference.membrane = reference.bending = reference.shear = NAN;
  reference.rows.clear();
  return reference;
}

problem::Problem manufactured_problem(const Manufactured& exact, int degree, int refinements) {
  const auto& [E, nu, e, k_s] = exact.shell();
  problem::Problem problem;
  problem.domain = domain::Rectangle{.cells = {2, 2}};
  problem.charts.emplace("", geometry::Chart(Manufactured::chart(), {}));
  problem.shell.sections.common.thickness = Expression(e);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(E, nu, k_s);
  problem.shell.supports = {clamped("left"), clamped("right"), clamped("bottom"), clamped("top")};
  energy::AreaLoad load{};
  load.force_function = [exact](double x, double y) { return exact.force(x, y); };
  load.couple_function = [exact](double x, double y) { return exact.couple(x, y); };
  problem.shell.loads.on_areas = {load};
  if (exact.solution() == ManufacturedSolution::contact) problem.shell.obstacles.all = {obstacle::Obstacle{}};
  problem.discretisation = {.degree = degree, .refinements = refinements};
  return problem;
}

LinearReference hyperbolic_paraboloid(double thickness, ShearCorrection k, bool half, int degree, int refinements) {
  LinearReference reference{.name = fmt::format("hyperbolic paraboloid, e = {}", thickness),
                            .problem = free_shell(2e11, 0.3, k, thickness, degree, refinements),
                            .direction = -Eigen::Vector3d::UnitZ()};
  problem::Problem& problem = reference.problem;
  problem.domain = domain::Rectangle{.from = {-0.5, half ? 0 : -0.5}, .to = {0.5, 0.5}, .cells = {2, half ? 1 : 2}};
  problem.charts.emplace("", geometry::Chart({"x", "y", "x^2 - y^2"}, {}));
  problem.shell.supports = {clamped("left")};
  if (half) problem.shell.supports.push_back(symmetry("bottom"));
  problem.shell.loads.on_areas = {downward(8000 * thickness)};
  problem.probes = {{"free end", {0.5, 0}}};
  const auto [displacement, energy] = saddle_values(thickness, k);
  reference.displacement = displacement;
  reference.energy = energy / (half ? 2 : 1);
  return reference;
}

LinearReference free_hyperboloid(double thickness, ShearCorrection k, int degree, int refinements) {
  LinearReference reference{.name = fmt::format("free hyperboloid, e = {}", thickness),
                            .problem = free_shell(2.85e4, 0.3, k, thickness, degree, refinements),
                            .direction = Eigen::Vector3d::UnitX()};
  problem::Problem& problem = reference.problem;
  problem.domain = domain::Rectangle{.from = {0, 0}, .to = {std::numbers::pi / 2, 1}, .cells = {2, 2}};
  problem.charts.emplace("", geometry::Chart({"sqrt(1 + y^2)*cos(x)", "sqrt(1 + y^2)*sin(x)", "y"}, {}));
  problem.shell.supports = {symmetry("left"), symmetry("right"), symmetry("bottom")};  // y = 0, x = 0, z = 0
  energy::AreaLoad load{};
  load.pressure = Expression("p*cos(2*x)", {{"p", 1e4 * std::pow(thickness, 3)}});  // a_3 points away from the axis
  problem.shell.loads.on_areas = {load};
  problem.probes = {{"waist", {0, 0}}};
  reference.displacement =
      thick(thickness, 0.1, 0.01) ? pick(k, 0.1895456673, 0.1889675821) : pick(k, 0.1504661764, 0.1504485744);
  return reference;
}

LinearReference scordelis_lo(ShearCorrection k, bool hard_diaphragm, int degree, int refinements) {
  LinearReference reference{
      .name = hard_diaphragm ? "Scordelis-Lo roof, hard diaphragm" : "Scordelis-Lo roof, soft diaphragm",
      .problem = free_shell(4.32e8, 0, k, 0.25, degree, refinements),
      .direction = -Eigen::Vector3d::UnitZ()};
  problem::Problem& problem = reference.problem;
  const double R = 25, half_arc = R * 40 * std::numbers::pi / 180;  // x is the arc length from the crown, y the axis
  problem.domain = domain::Rectangle{.from = {0, 0}, .to = {half_arc, 25}, .cells = {2, 3}};
  problem.charts.emplace("", geometry::Chart({"R*sin(x/R)", "y", "R*cos(x/R)"}, {{"R", R}}));
  Support diaphragm{
      .boundary = "top",
      .components = {zero(Unknown::displacement, Direction::x), zero(Unknown::displacement, Direction::z)}};
  if (hard_diaphragm) diaphragm.components.push_back(zero(Unknown::rotation, Direction::tangent));
  problem.shell.supports = {symmetry("left"), symmetry("bottom"), diaphragm};
  problem.shell.loads.on_areas = {downward(90)};
  problem.probes = {{"free edge", {half_arc, 0}}};
  reference.displacement = hard_diaphragm ? pick(k, 0.3014541527, 0.3013764662) : pick(k, 0.302025, 0.301897);
  return reference;
}

LinearReference clamped_plate(double thickness, ShearCorrection k, int degree, int refinements) {
  const double E = 1, nu = 0.3, D = E * std::pow(thickness, 3) / (12 * (1 - nu * nu));
  LinearReference reference{.name = fmt::format("clamped plate, e = {}", thickness),
                            .problem = free_shell(E, nu, k, thickness, degree, refinements),
                            .direction = -Eigen::Vector3d::UnitZ()};
  problem::Problem& problem = reference.problem;
  problem.domain = domain::Rectangle{.from = {0, 0}, .to = {0.5, 0.5}, .cells = {2, 2}};
  problem.charts.emplace("", geometry::Chart({"x", "y", "0"}, {}));
  problem.shell.supports = {clamped("left"), clamped("bottom"), symmetry("right"), symmetry("top")};
  problem.shell.loads.on_areas = {downward(D)};
  problem.probes = {{"centre", {0.5, 0.5}}};
  reference.displacement =
      thick(thickness, 0.1, 0.01) ? pick(k, 0.0015046257, 0.0014659242) : pick(k, 0.0012678586, 0.0012674363);
  return reference;
}

LinearReference clamped_saddle(int degree, int refinements) {
  LinearReference reference{.name = "clamped saddle over a diamond",
                            .problem = free_shell(2.85e4, 0.4, ShearCorrection::one, 0.8, degree, refinements),
                            .direction = -Eigen::Vector3d::UnitZ()};
  problem::Problem& problem = reference.problem;
  const double corner = 50 * std::numbers::sqrt2;
  problem.domain = domain::Polygon{{{corner, 0}, {0, corner}, {-corner, 0}, {0, -corner}}};
  problem.charts.emplace("", geometry::Chart({"x", "y", "c*(x^2 - y^2)/(2*b^2)"}, {{"b", 50}, {"c", 10}}));
  for (const char* edge : {"edge1", "edge2", "edge3", "edge4"}) problem.shell.supports.push_back(clamped(edge));
  problem.shell.loads.on_areas = {downward(0.01)};
  problem.probes = {{"centre", {0, 0}}};
  reference.displacement = 0.0248389;
  return reference;
}

}  // namespace plastron::verification
