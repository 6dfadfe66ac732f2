#include <plastron/io/fields.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace plastron::io {

namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using recovery::PointValues;
using Values = std::array<double, 3>;

constexpr double lower = -1, middle = 0, upper = 1;  // heights as multiples of e/2

Values three(const Vector3d& v) { return {v[0], v[1], v[2]}; }
Values three(const Vector2d& v) { return {v[0], v[1], 0}; }
Values three(double value) { return {value, 0, 0}; }

/// Returns a point of the deformed shell at the height z, a multiple of e/2.
Vector3d deformed(const PointValues& p, double side) { return p.phi + p.u + side * p.thickness / 2 * (p.a3 + p.r); }

Vector3d stress(const PointValues& p, double side) {
  return shell::in_plane_stress(section_forces(p), side * p.thickness / 2);
}

Vector2d principal_values(const Vector3d& tensor) {
  const auto principal = shell::principal(tensor);
  return {principal.first, principal.second};
}

Vector2d principal_stress(const PointValues& p, double side) { return principal_values(stress(p, side)); }

/// Returns the tangent direction of the first principal value.
Vector3d principal_direction(const PointValues& p, const Vector3d& tensor) {
  const double angle = shell::principal(tensor).angle;
  return std::cos(angle) * p.t1 + std::sin(angle) * p.t2;
}

double von_mises(const PointValues& p, double side) {
  return shell::von_mises_at(section_forces(p), side * p.thickness / 2);
}

/// Limits `touching` to 0 and 1, its values at nodes, because its interpolation overshoots between them.
double contact_between(double touching) { return std::clamp(touching, 0.0, 1.0); }

/// Makes a field with as many components as `take` returns.
template <class Take>
Field field(std::string key, std::vector<std::string> arrays, std::string_view symbol, std::string_view unit,
            std::string meaning, Take take, Presence presence = Presence::always) {
  using Value = std::invoke_result_t<Take, const PointValues&>;
  constexpr int components = std::is_same_v<Value, double> ? 1 : std::is_same_v<Value, Vector2d> ? 2 : 3;
  static_assert(components < 3 || std::is_same_v<Value, Vector3d>);
  return {std::move(key),     std::move(arrays), symbol,   unit,
          std::move(meaning), components,        presence, [take](const PointValues& p) { return three(take(p)); }};
}

const std::vector<Field>& table() {
  static const std::vector<Field> all{
      field("x", {"x", "y"}, "x, y", "the chart's", "parameters in Omega", [](auto& p) { return p.x; }),
      field("position", {"reference position"}, "phi", "m", "position on the undeformed mid-surface",
            [](auto& p) { return p.phi; }),
      field("u", {"displacement"}, "u", "m", "displacement of the mid-surface", [](auto& p) { return p.u; }),
      field("r", {"rotation"}, "r", "rad", "change of the normal, tangent to the surface", [](auto& p) { return p.r; }),
      field("lower_face", {"lower face"}, "-", "m", "deformed lower face, phi + u - e/2 (a_3 + r)",
            [](auto& p) { return deformed(p, lower); }),
      field("upper_face", {"upper face"}, "-", "m", "deformed upper face, phi + u + e/2 (a_3 + r)",
            [](auto& p) { return deformed(p, upper); }),
      field(
          "gap", {"gap"}, "g", "m", "distance of the touching face from the obstacle", [](auto& p) { return p.gap; },
          Presence::with_obstacle),
      field(
          "eta", {"eta"}, "eta", "Pa", "contact pressure: reaction of the obstacle per unit mid-surface area",
          [](auto& p) { return p.pressure; }, Presence::with_obstacle),
      field(
          "contact", {"contact"}, "-", "1",
          "1 in contact, 0 where free, between 0 and 1 next to the edge of a contact zone",
          [](auto& p) { return contact_between(p.touching); }, Presence::with_obstacle),
      field(
          "foundation", {"foundation"}, "-K w", "N/m^2",
          "force of foundations under areas on the shell, without that of shear layers",
          [](auto& p) { return p.carried; }, Presence::with_foundation),
      field("N", {"N_11", "N_22", "N_12"}, "N^ab", "N/m", "membrane forces in the axes t1, t2",
            [](auto& p) { return p.N; }),
      field("M", {"M_11", "M_22", "M_12"}, "M^ab", "N", "bending moments (N m per m) in the axes t1, t2",
            [](auto& p) { return p.M; }),
      field("Q", {"Q_1", "Q_2"}, "Q^a", "N/m", "transverse shear forces in the axes t1, t2",
            [](auto& p) { return p.Q; }),
      field("N_principal", {"N_I", "N_II"}, "N_I, N_II", "N/m", "principal membrane forces, the larger first",
            [](auto& p) { return principal_values(p.N); }),
      field("N_direction", {"N direction"}, "-", "1", "unit tangent along which N_I acts",
            [](auto& p) { return principal_direction(p, p.N); }),
      field("M_principal", {"M_I", "M_II"}, "M_I, M_II", "N", "principal bending moments, the larger first",
            [](auto& p) { return principal_values(p.M); }),
      field("M_direction", {"M direction"}, "-", "1", "unit tangent along which M_I acts",
            [](auto& p) { return principal_direction(p, p.M); }),
      field("stress_lower", {"stress_11_lower", "stress_22_lower", "stress_12_lower"}, "sigma^ab", "Pa",
            "stresses in the axes t1, t2 at the lower face, z = -e/2", [](auto& p) { return stress(p, lower); }),
      field("principal_stress_lower", {"stress_I_lower", "stress_II_lower"}, "sigma_I, sigma_II", "Pa",
            "principal stresses at the lower face, z = -e/2, the larger first",
            [](auto& p) { return principal_stress(p, lower); }),
      field("von_mises_lower", {"von_mises_lower"}, "-", "Pa",
            "equivalent stress of von Mises at the lower face, z = -e/2", [](auto& p) { return von_mises(p, lower); }),
      field("stress_middle", {"stress_11_middle", "stress_22_middle", "stress_12_middle"}, "sigma^ab", "Pa",
            "stresses in the axes t1, t2 at the mid-surface", [](auto& p) { return stress(p, middle); }),
      field("principal_stress_middle", {"stress_I_middle", "stress_II_middle"}, "sigma_I, sigma_II", "Pa",
            "principal stresses at the mid-surface, the larger first",
            [](auto& p) { return principal_stress(p, middle); }),
      field("von_mises_middle", {"von_mises_middle"}, "-", "Pa", "equivalent stress of von Mises at the mid-surface",
            [](auto& p) { return von_mises(p, middle); }),
      field("stress_upper", {"stress_11_upper", "stress_22_upper", "stress_12_upper"}, "sigma^ab", "Pa",
            "stresses in the axes t1, t2 at the upper face, z = e/2", [](auto& p) { return stress(p, upper); }),
      field("principal_stress_upper", {"stress_I_upper", "stress_II_upper"}, "sigma_I, sigma_II", "Pa",
            "principal stresses at the upper face, z = e/2, the larger first",
            [](auto& p) { return principal_stress(p, upper); }),
      field("von_mises_upper", {"von_mises_upper"}, "-", "Pa",
            "equivalent stress of von Mises at the upper face, z = e/2", [](auto& p) { return von_mises(p, upper); }),
      field("von_mises", {"von_mises"}, "-", "Pa",
            "largest equivalent stress of von Mises over the thickness, with the parabolic shear stress",
            [](auto& p) { return shell::largest_von_mises(section_forces(p)).stress; }),
      field(
          "shear_stress", {"shear_stress_1", "shear_stress_2"}, "sigma^a3", "Pa",
          "transverse shear stresses in the axes t1, t2, mean over the thickness: Q^a / e (in solid.vtu: the parabola)",
          [](auto& p) { return shell::mean_shear_stress(section_forces(p)); }),
      field("shear_stress_middle", {"shear_stress_1_middle", "shear_stress_2_middle"}, "sigma^a3", "Pa",
            "transverse shear stresses in the axes t1, t2 at the mid-surface, by the parabola over the thickness: 3/2 "
            "Q^a / e",
            [](auto& p) { return shell::shear_stress(section_forces(p), 0); }),
      field("energy_density", {"energy_density_membrane", "energy_density_bending", "energy_density_shear"}, "-",
            "J/m^2", "stored energy per mid-surface area: membrane, bending, shear",
            [](auto& p) {
              const auto density = shell::energy_density(p.material, section_forces(p));
              return Vector3d(density.membrane, density.bending, density.shear);
            }),
      field(
          "lambda", {"lambda"}, "lambda", "N m", "multiplier of r . a_3 = 0 (mixed formulation)",
          [](auto& p) { return p.lambda; }, Presence::with_multiplier),
      field("frame/t1", {"t1"}, "t1", "1", "unit tangent along output.axis, or d phi/dx", [](auto& p) { return p.t1; }),
      field("frame/t2", {"t2"}, "t2", "1", "unit tangent a3 x t1", [](auto& p) { return p.t2; }),
      field("frame/a3", {"a3"}, "a_3", "1", "unit normal", [](auto& p) { return p.a3; }),
      field("thickness", {"thickness"}, "e", "m", "full thickness of the shell", [](auto& p) { return p.thickness; }),
      field("curvatures", {"kappa_1", "kappa_2"}, "kappa", "1/m",
            "principal curvatures of the undeformed mid-surface, the larger last; positive if it bends towards a_3",
            [](auto& p) { return p.curvatures; }),
  };
  return all;
}

/// Adds the stresses at z = height e.
void add_height(double height, std::vector<Field>& fields) {
  const double side = 2 * height;
  const std::string at = fmt::format("_at_{}", height), where = fmt::format(" at z = {} e", height);
  fields.push_back(field("stress" + at, {"stress_11" + at, "stress_22" + at, "stress_12" + at}, "sigma^ab", "Pa",
                         "stresses in the axes t1, t2" + where,
                         [side](const PointValues& p) { return stress(p, side); }));
  fields.push_back(field("principal_stress" + at, {"stress_I" + at, "stress_II" + at}, "sigma_I, sigma_II", "Pa",
                         "principal stresses" + where + ", the larger first",
                         [side](const PointValues& p) { return principal_stress(p, side); }));
  fields.push_back(
      field("shear_stress" + at, {"shear_stress_1" + at, "shear_stress_2" + at}, "sigma^a3", "Pa",
            "transverse shear stresses in the axes t1, t2, by the parabola over the thickness," + where,
            [side](const PointValues& p) { return shell::shear_stress(section_forces(p), side * p.thickness / 2); }));
  fields.push_back(field("von_mises" + at, {"von_mises" + at}, "-", "Pa", "equivalent stress of von Mises" + where,
                         [side](const PointValues& p) { return von_mises(p, side); }));
}

/// Returns the stresses of layer k at its lower (0), middle (1/2) or upper (1) height, in its axes.
shell::Stress layer_stress(const PointValues& p, std::size_t k, double part) {
  if (!p.laminate || k >= p.laminate->layer_count()) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {Vector3d::Constant(none), Eigen::Vector2d::Constant(none)};
  }
  const double bottom = p.laminate->interface(k), top = p.laminate->interface(k + 1);
  return shell::stress_of(p.laminate->stress_in_layer_axes(k, bottom + part * (top - bottom)), section_forces(p));
}

/// Adds the stresses of layer k, counted from 0 at the lower face.
void add_layer(std::size_t k, std::vector<Field>& fields) {
  const std::string name = fmt::format("layer_{}", k + 1);
  for (const auto& [where, part] : {std::pair("_lower", 0.0), std::pair("_upper", 1.0)}) {
    const std::string end = "_" + name + where;
    fields.push_back(field(name + where, {"stress_11" + end, "stress_22" + end, "stress_12" + end}, "sigma_ab", "Pa",
                           fmt::format("stresses in the axes of layer {} at its {} side", k + 1, where + 1),
                           [k, part = part](const PointValues& p) { return layer_stress(p, k, part).in_plane; }));
  }
  fields.push_back(field(name + "_shear", {"shear_stress_1_" + name, "shear_stress_2_" + name}, "sigma_a3", "Pa",
                         fmt::format("transverse shear stresses in the axes of layer {} in its middle", k + 1),
                         [k](const PointValues& p) { return layer_stress(p, k, 0.5).shear; }));
}

}  // namespace

std::span<const Field> fields() { return table(); }

Ingredients ingredients_of(const assembly::DiscreteShell& discrete) {
  return {.obstacle = !discrete.obstacles.empty(),
          .multiplier = discrete.tangency.formulation == element::Formulation::mixed,
          .foundation =
              std::ranges::any_of(discrete.foundations, [](const auto& own) { return own.first.is_under_area(); })};
}

bool is_present(const Field& field, const Ingredients& ingredients) {
  switch (field.presence) {
    case Presence::with_obstacle:
      return ingredients.obstacle;
    case Presence::with_multiplier:
      return ingredients.multiplier;
    case Presence::with_foundation:
      return ingredients.foundation;
    default:
      return true;
  }
}

std::vector<Field> fields_of(const Ingredients& ingredients, std::span<const double> heights, int layers) {
  std::vector<Field> present;
  std::copy_if(table().begin(), table().end(), std::back_inserter(present),
               [&](const Field& f) { return is_present(f, ingredients); });
  for (const double height : heights) add_height(height, present);
  for (int k = 0; k < layers; ++k) add_layer(static_cast<std::size_t>(k), present);
  return present;
}

}  // namespace plastron::io
