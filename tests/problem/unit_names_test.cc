// Names of units in labels and sentences.
#include <gtest/gtest.h>
#include <plastron/problem/unit_names.hpp>

namespace plastron::problem::unit_names_test {
namespace {

const UnitNames millimetres{"mm", "N"}, inches{"in", "lbf"}, feet{"ft", "kN"};

TEST(UnitNames, compose_those_of_length_and_force) {
  EXPECT_EQ(millimetres.label("m^2"), "mm^2");
  EXPECT_EQ(millimetres.label("N/m"), "N/mm");
  EXPECT_EQ(millimetres.label("N m"), "N mm");
  EXPECT_EQ(millimetres.label("1/m"), "1/mm");
  EXPECT_EQ(feet.label("N/m^2, N/m"), "kN/ft^2, kN/ft");
}

TEST(UnitNames, of_stress_and_energy_are_the_usual_ones) {
  EXPECT_EQ(millimetres.label("Pa"), "MPa");
  EXPECT_EQ(millimetres.label("J"), "mJ");
  EXPECT_EQ(millimetres.label("Pa m"), "MPa mm");
  EXPECT_EQ(inches.label("Pa"), "psi");
  EXPECT_EQ(feet.label("Pa"), "kN/ft^2");
  EXPECT_EQ(feet.label("J"), "kN ft");
}

TEST(UnitNames, leave_other_words_alone) {
  for (const char* word : {"1", "rad", "s", "see unit", "the chart's", "time", "cells"})
    EXPECT_EQ(millimetres.label(word), word);
}

TEST(UnitNames, replace_units_after_numbers_and_in_brackets) {
  EXPECT_EQ(millimetres.renamed("moved by 2.5 m, to (1, 2, 3) m; carries 4e-3 N/m."),
            "moved by 2.5 mm, to (1, 2, 3) mm; carries 4e-3 N/mm.");
  EXPECT_EQ(millimetres.renamed("<span>7</span> N m and [N m], s [m]"), "<span>7</span> N mm and [N mm], s [mm]");
  EXPECT_EQ(millimetres.renamed("area 2 m^2 at 3 Pa"), "area 2 mm^2 at 3 MPa");
  EXPECT_EQ(millimetres.renamed("5 m"), "5 mm");
}

TEST(UnitNames, leave_what_is_no_unit) {
  for (const char* text : {"step 2 mixed", "5 Newton", "m = 3", "[mesh]", "N_11 [1]", "5 m/s", "1 N2", "at 3 more"})
    EXPECT_EQ(millimetres.renamed(text), text);
}

TEST(UnitNames, are_replaced_once) {
  for (const UnitNames& units : {millimetres, inches, feet}) {
    const std::string once = units.renamed("2 m, 3 N/m, 4 Pa, 5 J, 6 N m, [m], [Pa]");
    EXPECT_EQ(units.renamed(once), once);
  }
}

TEST(UnitNames, of_SI_change_nothing) { EXPECT_EQ(UnitNames{}.renamed("2 m, 3 Pa, 4 J"), "2 m, 3 Pa, 4 J"); }

}  // namespace
}  // namespace plastron::problem::unit_names_test
