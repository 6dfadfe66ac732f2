#include <plastron/io/fields.hpp>

#include <algorithm>

namespace plastron::io {

namespace {

using certificate::PointValues;
using Values = std::array<double, 3>;

Values three(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// `touching` is 0 or 1 at nodes; its interpolation overshoots between them.
double contact_between(double touching) { return std::clamp(touching, 0.0, 1.0); }

const std::vector<Field>& table() {
  static const std::vector<Field> all{
      {"x",
       {"x", "y"},
       "x, y",
       "the chart's",
       "parameters in Omega",
       2,
       Presence::always,
       [](const PointValues& p) {
         return Values{p.x[0], p.x[1], 0};
       }},
      {"position",
       {"reference position"},
       "phi",
       "m",
       "position on the undeformed mid-surface",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.phi); }},
      {"u",
       {"displacement"},
       "u",
       "m",
       "displacement of the mid-surface",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.u); }},
      {"r",
       {"rotation"},
       "r",
       "rad",
       "change of the normal, tangent to the surface",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.r); }},
      {"gap",
       {"gap"},
       "g",
       "m",
       "distance of the touching face from the obstacle",
       1,
       Presence::with_obstacle,
       [](const PointValues& p) {
         return Values{p.gap, 0, 0};
       }},
      {"eta",
       {"eta"},
       "eta",
       "Pa",
       "reaction of the obstacle per unit mid-surface area",
       1,
       Presence::with_obstacle,
       [](const PointValues& p) {
         return Values{p.pressure, 0, 0};
       }},
      {"contact",
       {"contact"},
       "-",
       "1",
       "1 in contact, 0 free, in between next to the edge of the contact zone",
       1,
       Presence::with_obstacle,
       [](const PointValues& p) {
         return Values{contact_between(p.touching), 0, 0};
       }},
      {"N",
       {"N_11", "N_22", "N_12"},
       "N^ab",
       "N/m",
       "membrane forces in the axes t1, t2",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.N); }},
      {"M",
       {"M_11", "M_22", "M_12"},
       "M^ab",
       "N",
       "bending moments (N m per m) in the axes t1, t2",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.M); }},
      {"Q",
       {"Q_1", "Q_2"},
       "Q^a",
       "N/m",
       "transverse shear forces in the axes t1, t2",
       2,
       Presence::always,
       [](const PointValues& p) {
         return Values{p.Q[0], p.Q[1], 0};
       }},
      {"lambda",
       {"lambda"},
       "lambda",
       "N m",
       "multiplier of r . a_3 = 0 (mixed formulation)",
       1,
       Presence::with_multiplier,
       [](const PointValues& p) {
         return Values{p.lambda, 0, 0};
       }},
      {"frame/t1",
       {"t1"},
       "t1",
       "1",
       "unit tangent along d phi/dx",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.t1); }},
      {"frame/t2",
       {"t2"},
       "t2",
       "1",
       "unit tangent a3 x t1",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.t2); }},
      {"frame/a3",
       {"a3"},
       "a_3",
       "1",
       "unit normal",
       3,
       Presence::always,
       [](const PointValues& p) { return three(p.a3); }},
      {"thickness",
       {"thickness"},
       "e",
       "m",
       "full thickness of the shell",
       1,
       Presence::always,
       [](const PointValues& p) {
         return Values{p.thickness, 0, 0};
       }},
  };
  return all;
}

}  // namespace

std::span<const Field> fields() { return table(); }

bool is_present(const Field& field, bool has_obstacle, bool has_multiplier) {
  return field.presence == Presence::always || (field.presence == Presence::with_obstacle && has_obstacle) ||
         (field.presence == Presence::with_multiplier && has_multiplier);
}

std::vector<Field> fields_of(bool has_obstacle, bool has_multiplier) {
  std::vector<Field> present;
  std::copy_if(table().begin(), table().end(), std::back_inserter(present),
               [&](const Field& f) { return is_present(f, has_obstacle, has_multiplier); });
  return present;
}

}  // namespace plastron::io
