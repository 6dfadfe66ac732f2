// How wide the contact is against the cells and the thickness. Zones that fill no cell and are narrower than half the
// thickness are lines or points of contact: their reaction is concentrated, and no mesh shows a pressure (docs/model.md,
// section 6).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::solution {

class ContactWidth {
 public:
  /// `touching`: of contact_faces(), positive at local nodes that touch an obstacle. `discrete` must outlive this object.
  ContactWidth(const assembly::DiscreteShell& discrete, algebra::Vector touching)
      : discrete_(discrete), touching_(std::move(touching)) {}

  bool touches(std::size_t node, std::size_t obstacle) const {
    return touching_.local()[node * static_cast<std::size_t>(touching_.block()) + obstacle] > 0.5;
  }
  /// Returns the direction of a cell, 0 or 1, along which more pairs of neighbouring nodes differ in touching: the edge of the zone
  /// runs across it. 0 in triangles.
  int direction_across(std::size_t cell, std::size_t obstacle) const;
  /// Marks by local node and obstacle, positive in zones that fill a cell or are wider than half the thickness
  /// (collective).
  algebra::Vector with_area() const;
  /// Marks likewise, positive in zones with a cell away from their edge (collective).
  algebra::Vector with_inside() const;

 private:
  std::ptrdiff_t touching_nodes(std::size_t cell, std::size_t obstacle) const;
  bool is_full(std::size_t cell, std::size_t obstacle) const;
  /// Whether a row of touching nodes of the cell across the zone is longer than e/2.
  bool is_wider_than_a_line(std::size_t cell, std::size_t obstacle) const;
  /// Marks all nodes of the owned cells for which `belongs` is true, by obstacle (collective).
  template <class Belongs>
  algebra::Vector marked(const Belongs& belongs) const;
  bool has_one_of(const algebra::Vector& marks, std::size_t cell, std::size_t obstacle) const;
  /// Marks the nodes of touching cells beside marked nodes, too (collective).
  algebra::Vector spread(const algebra::Vector& marks) const;

  const assembly::DiscreteShell& discrete_;
  algebra::Vector touching_;
};

}  // namespace plastron::solution
