#include <plastron/energy/cell_packs.hpp>

#include <plastron/element/element_tables.hpp>
#include <plastron/shell/material.hpp>

namespace plastron::energy {

using geometry::Vector3d;

CellPacks::Table::Table(const Eigen::MatrixXd& table)
    : values(static_cast<std::size_t>(table.size())),
      transposed(values.size()),
      rows(static_cast<int>(table.rows())),
      columns(static_cast<int>(table.cols())) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(values.data(), table.rows(), table.cols()) = table;
  Eigen::Map<RowMajor>(transposed.data(), table.cols(), table.rows()) = table.transpose();
}

CellPacks::CellPacks(const fem::Space& space, const fem::Surface& surface, const CrossSections& sections,
                     const element::ElementTables& tables, const PackKernels& kernels)
    : kernels_(&kernels),
      kind_(tables.shape == mesh::Shape::triangle ? PackedCells::Kind::plain
            : tables.tying                        ? PackedCells::Kind::tied
                                                  : PackedCells::Kind::square),
      has_directors_(surface.has_directors()),
      xi_(tables.quadrature.xi),
      weights_(tables.weights) {
  set_tables(tables);
  std::size_t sampling_points = 0;
  for (const auto& xi : sampling_xi_) sampling_points += xi.size();
  const std::size_t packs = (space.owned_cells + lanes() - 1) / lanes();
  const auto lines = [&](std::size_t quantities) { return (packs * quantities * lanes() + 7) / 8; };
  points_.resize(lines(xi_.size() * point_size()));
  samplings_.resize(lines(sampling_points * PackedCells::sampling_size));
  materials_.resize(lines(PackedCells::material_size));
  if (sections.most_layers() > 0) sections_.resize(lines(xi_.size() * PackedCells::section_size));
  for (std::size_t to = 0; to < packs * lanes(); ++to) {
    // Lanes without a cell get the last cell, so that their results are finite.
    const fem::Cell& cell = space.cells[std::min(to, space.owned_cells - 1)];
    const CrossSection& section = sections.at(*space.coarse, cell);
    set_points(surface, section, cell, to);
    set_sampling_points(surface, cell, to);
    set_material(section.material, to);
    if (!sections_.empty()) set_sections(section.material, to);
  }
}

void CellPacks::set_material(const shell::Material& m, std::size_t to) {
  const shell::Isotropic isotropic = m.isotropic() ? *m.isotropic() : shell::Isotropic{};
  const double quantities[] = {m.isotropic() ? isotropic.lambda_plane_stress() : 0, isotropic.mu,
                               m.shear_correction * isotropic.mu, m.young()};
  for (std::size_t k = 0; k < std::size(quantities); ++k)
    data(materials_)[place(to, 1, 0, PackedCells::material_size) + k * lanes()] = quantities[k];
}

void CellPacks::set_sections(const shell::Material& material, std::size_t to) {
  for (std::size_t q = 0; q < xi_.size(); ++q) {
    const shell::Section s = shell::section_at(material, frame(to, q), thickness(to, q));
    double* out = data(sections_) + place(to, xi_.size(), q, PackedCells::section_size);
    const auto put = [&](const auto& matrix) {
      for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (Eigen::Index j = 0; j <= i; ++j, out += lanes()) *out = matrix(i, j);
    };
    put(s.membrane);
    put(s.coupling);
    put(s.bending);
    put(s.shear);
  }
}

void CellPacks::set_tables(const element::ElementTables& tables) {
  if (kind_ == PackedCells::Kind::plain) {
    cell_value_ = Table(tables.quadrature.value);
    cell_d1_ = Table(tables.quadrature.d1);
    cell_d2_ = Table(tables.quadrature.d2);
    return;
  }
  const element::LineTables line = element::line_tables(tables.degree);
  value_ = Table(line.full.value);
  d_ = Table(line.full.d);
  if (kind_ == PackedCells::Kind::square) return;
  reduced_value_ = Table(line.reduced.value);
  reduced_d_ = Table(line.reduced.d);
  from_reduced_ = Table(line.from_reduced);
  for (const element::Sampling& sampling : tables.samplings) sampling_xi_.push_back(sampling.basis.xi);
}

void CellPacks::set_points(const fem::Surface& surface, const CrossSection& section, const fem::Cell& cell,
                           std::size_t to) {
  std::vector<geometry::Frame> frames(xi_.size());
  std::vector<double> e(xi_.size());
  surface.frames(cell, xi_, frames);
  surface.evaluate(section.thickness, cell, xi_, e);
  for (std::size_t q = 0; q < xi_.size(); ++q) {
    double* out = data(points_) + place(to, xi_.size(), q, point_size());
    const auto put = [&](double quantity) {
      *out = quantity;
      out += lanes();
    };
    const auto put_vector = [&](const Vector3d& v) {
      for (const double component : v) put(component);
    };
    for (const Vector3d& a : frames[q].a_cov) put_vector(a);
    put(e[q]);
    if (has_directors_) {
      put_vector(frames[q].a3);
      for (const Vector3d& d : frames[q].da3) put_vector(d);
      continue;
    }
    for (const auto& [a, b] : {std::pair(0, 0), {1, 1}, {0, 1}}) put(frames[q].b_cov(a, b));
  }
}

void CellPacks::set_sampling_points(const fem::Surface& surface, const fem::Cell& cell, std::size_t to) {
  std::size_t points = 0, first = 0;
  for (const auto& xi : sampling_xi_) points += xi.size();
  for (std::size_t set = 0; set < sampling_xi_.size(); ++set) {
    std::vector<geometry::Frame> frames(sampling_xi_[set].size());
    surface.frames(cell, sampling_xi_[set], frames, false);
    for (std::size_t t = 0; t < frames.size(); ++t) {
      double* out = data(samplings_) + place(to, points, first + t, PackedCells::sampling_size);
      const Vector3d& one = frames[t].a_cov[set == 1 ? 1 : 0];
      const Vector3d& other = set == 2 ? frames[t].a_cov[1] : frames[t].a3;
      for (std::size_t k = 0; k < 3; ++k) {
        out[k * lanes()] = one[static_cast<Eigen::Index>(k)];
        out[(3 + k) * lanes()] = other[static_cast<Eigen::Index>(k)];
      }
    }
    first += frames.size();
  }
}

geometry::Frame CellPacks::frame(std::size_t cell, std::size_t q) const {
  const double* in = point(cell, q);
  const auto vector = [&](std::size_t first) {
    return Vector3d(in[first * lanes()], in[(first + 1) * lanes()], in[(first + 2) * lanes()]);
  };
  if (has_directors_)
    return geometry::frame_with_director(Vector3d::Zero(), {vector(0), vector(3)}, vector(7), {vector(10), vector(13)});
  // This jet has the stored curvature. No caller uses the tangential parts of its second derivatives.
  geometry::SurfaceJet jet{.d = {vector(0), vector(3)}};
  const Vector3d a3 = geometry::unit_normal(jet);
  jet.dd = {in[7 * lanes()] * a3, in[9 * lanes()] * a3, in[8 * lanes()] * a3};
  return geometry::frame_at(jet);
}

SamplingPoint CellPacks::sampling_point(std::size_t set, std::size_t cell, std::size_t t) const {
  if (sampling_xi_.empty()) {
    const geometry::Frame f = frame(cell, t);
    return {f.a_cov, f.a3};
  }
  std::size_t points = 0, first = 0;
  for (std::size_t s = 0; s < sampling_xi_.size(); ++s) {
    if (s == set) first = points;
    points += sampling_xi_[s].size();
  }
  const double* in = data(samplings_) + place(cell, points, first + t, PackedCells::sampling_size);
  const Vector3d one(in[0], in[lanes()], in[2 * lanes()]), other(in[3 * lanes()], in[4 * lanes()], in[5 * lanes()]);
  switch (static_cast<element::TiedGroup>(set)) {
    case element::TiedGroup::along_1:
      return {.a_cov = {one, Vector3d::Zero()}, .a3 = other};
    case element::TiedGroup::along_2:
      return {.a_cov = {Vector3d::Zero(), one}, .a3 = other};
    case element::TiedGroup::mixed:
      break;
  }
  return {.a_cov = {one, other}};
}

PackedCells CellPacks::view(const fem::Space& space) const {
  return {.kind = kind_,
          .has_directors = has_directors_,
          .cells = space.owned_cells,
          .nodes_per_cell = space.nodes_per_cell(),
          .points_per_cell = static_cast<int>(weights_.size()),
          .nodes = space.owned_cells ? space.nodes(0).data() : nullptr,
          .points = data(points_),
          .samplings = data(samplings_),
          .materials = data(materials_),
          .sections = data(sections_),
          .weights = weights_.data(),
          .value = value_.view(),
          .d = d_.view(),
          .reduced_value = reduced_value_.view(),
          .reduced_d = reduced_d_.view(),
          .from_reduced = from_reduced_.view(),
          .cell_value = cell_value_.view(),
          .cell_d1 = cell_d1_.view(),
          .cell_d2 = cell_d2_.view()};
}

}  // namespace plastron::energy
