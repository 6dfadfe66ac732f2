#include <plastron/element/line_tables.hpp>

namespace plastron::element {

LineTables line_tables(int degree) {
  const auto nodes = fem::gauss_lobatto(degree + 1).points;
  const auto full = fem::gauss(degree + 1).points, reduced = fem::gauss(degree).points;
  return {.full = fem::lagrange_table(nodes, full),
          .reduced = fem::lagrange_table(nodes, reduced),
          .from_reduced = fem::lagrange_table(reduced, full).value};
}

}  // namespace plastron::element
