#include <plastron/energy/shell_operator.hpp>

#include <plastron/shell/material.hpp>

#include <algorithm>
#include <iterator>

namespace plastron::energy {

using geometry::Frame;
using geometry::Vector3d;
using shell::LocalField;

namespace {

Energies over_ranks(const Energies& energies, MPI_Comm comm) {
  return {.membrane = algebra::sum_over_ranks(energies.membrane, comm),
          .bending = algebra::sum_over_ranks(energies.bending, comm),
          .shear = algebra::sum_over_ranks(energies.shear, comm)};
}

}  // namespace

ShellOperator::ShellOperator(std::shared_ptr<const fem::Space> space, std::shared_ptr<const fem::Surface> surface,
                             CrossSections sections, bool tying, bool is_covariant, const PackKernels& kernels)
    : space_(std::move(space)),
      surface_(std::move(surface)),
      sections_(std::move(sections)),
      tables_(element::element_tables(space_->shape(), space_->degree, tying)),
      interpolation_(space_, surface_, tables_, is_covariant),
      packs_(*space_, *surface_, sections_, tables_, kernels),
      sampling_bases_(tables_.samplings.size()) {
  check_regions(sections_, *space_->coarse);
  if (sections_.are_heated()) {
    temperatures_.resize(space_->owned_cells);
    for (std::size_t c = 0; c < space_->owned_cells; ++c)
      for (const Temperature& temperature : section(c).temperatures)
        temperatures_[c].push_back(values_of(temperature, c, tables_.quadrature.xi));
  }
  if (!is_covariant) return;
  for (std::size_t c = 0; c < space_->owned_cells; ++c) {
    std::ranges::move(interpolation_.bases(c, tables_.quadrature.xi), std::back_inserter(quadrature_bases_));
    for (std::size_t s = 0; s < tables_.samplings.size(); ++s)
      std::ranges::move(interpolation_.bases(c, tables_.samplings[s].basis.xi), std::back_inserter(sampling_bases_[s]));
  }
}

QuadraturePoint ShellOperator::point(std::size_t cell, int q) const {
  PLASTRON_ASSERT(cell < space_->owned_cells && q >= 0 && q < tables_.points_per_cell(), cell, space_->owned_cells, q,
                  tables_.points_per_cell());
  const auto p = static_cast<std::size_t>(q);
  const geometry::Frame frame = packs_.frame(cell, p);
  const double thickness = packs_.thickness(cell, p);
  const shell::Material& material = section(cell).material;
  return {frame, shell::section_at(material, frame, thickness), thickness, material.young(),
          frame.sqrt_a * tables_.weights[p]};
}

double ShellOperator::area(std::size_t cell) const {
  double area = 0;
  for (std::size_t q = 0; q < tables_.weights.size(); ++q) area += packs_.frame(cell, q).sqrt_a * tables_.weights[q];
  return area;
}

CellGeometry ShellOperator::geometry(std::size_t cell) const {
  CellGeometry at;
  at.frames.reserve(tables_.weights.size());
  for (std::size_t q = 0; q < tables_.weights.size(); ++q) at.frames.push_back(packs_.frame(cell, q));
  for (std::size_t s = 0; s < tables_.samplings.size(); ++s) {
    const std::size_t count = tables_.samplings[s].basis.xi.size();
    std::vector<SamplingPoint>& points = at.samplings.emplace_back();
    points.reserve(count);
    for (std::size_t t = 0; t < count; ++t) points.push_back(packs_.sampling_point(s, cell, t));
  }
  if (reference_.layout())
    change_points(cell, gather(cell, reference_), at,
                  [](auto& point, const LocalField<double>& v) { shell::replace(point, v); });
  return at;
}

CellGeometry ShellOperator::geometry(std::size_t cell, const element::CellField& moved) const {
  CellGeometry at = geometry(cell);
  change_points(cell, moved, at, [](auto& point, const LocalField<double>& v) { shell::deform(point, v); });
  return at;
}

template <class Change>
void ShellOperator::change_points(std::size_t cell, const element::CellField& field, CellGeometry& at,
                                  const Change& change) const {
  const element::FieldRows rows = interpolation_.fields(cell, tables_.quadrature, quadrature_bases(cell), field);
  for (std::size_t q = 0; q < at.frames.size(); ++q) change(at.frames[q], rows.at(static_cast<Eigen::Index>(q)));
  for (std::size_t s = 0; s < at.samplings.size(); ++s) {
    const element::FieldRows sampled =
        interpolation_.fields(cell, tables_.samplings[s].basis, sampling_bases(s, cell), field);
    for (std::size_t t = 0; t < at.samplings[s].size(); ++t)
      change(at.samplings[s][t], sampled.at(static_cast<Eigen::Index>(t)));
  }
}

void ShellOperator::assert_is_field([[maybe_unused]] const algebra::Vector& y,
                                    [[maybe_unused]] const char* what) const {
  PLASTRON_ASSERT(y.block() == 6 && y.local().size() == 6 * static_cast<std::size_t>(space_->layout->local_size()),
                  what, y.block(), y.local().size(), space_->layout->local_size());
}

element::CellField ShellOperator::gather(std::size_t cell, const algebra::Vector& y) const {
  assert_is_field(y, "gathered");
  const auto nodes = space_->nodes(cell);
  const auto values = y.local();
  element::CellField field(static_cast<Eigen::Index>(nodes.size()), 6);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int c = 0; c < 6; ++c)
      field(static_cast<Eigen::Index>(i), c) =
          values[static_cast<std::size_t>(nodes[i]) * 6 + static_cast<std::size_t>(c)];
  return field;
}

ShellOperator::SampledStrain ShellOperator::sampled_strains(std::size_t s, std::size_t cell,
                                                            const element::CellField& field,
                                                            const CellGeometry& geometry) const {
  const element::BasisAt& basis = tables_.samplings[s].basis;
  const element::FieldRows rows = interpolation_.fields(cell, basis, sampling_bases(s, cell), field);
  SampledStrain sampled(rows.value.rows(), 5);
  for (Eigen::Index t = 0; t < sampled.rows(); ++t) {
    const LocalField<double> v = rows.at(t);
    const SamplingPoint& at = geometry.samplings[s][static_cast<std::size_t>(t)];
    sampled.row(t).head<3>() = shell::membrane_strain(v, at.a_cov);
    sampled.row(t).tail<2>() = shell::shear_strain(v, at.a_cov, at.a3);
  }
  return sampled;
}

CellStrain ShellOperator::strains(std::size_t cell, const element::CellField& field, const CellGeometry& at) const {
  PLASTRON_ASSERT(field.rows() == tables_.nodes_per_cell(), field.rows(), tables_.nodes_per_cell());
  CellStrain strains = CellStrain::Zero(tables_.points_per_cell(), 8);
  const element::FieldRows rows = interpolation_.fields(cell, tables_.quadrature, quadrature_bases(cell), field);
  for (int q = 0; q < tables_.points_per_cell(); ++q)
    strains.row(q).segment<3>(3) = shell::bending_strain(rows.at(q), at.frames[static_cast<std::size_t>(q)]);
  for (std::size_t s = 0; s < tables_.samplings.size(); ++s) {
    const element::Sampling& sampling = tables_.samplings[s];
    const SampledStrain sampled = sampled_strains(s, cell, field, at);
    for (int q = 0; q < tables_.points_per_cell(); ++q)
      for (const auto& [t, weight] : sampling.to_quadrature[static_cast<std::size_t>(q)]) {
        for (const int m : sampling.membrane) strains(q, m) += weight * sampled(t, m);
        for (const int d : sampling.shear) strains(q, 6 + d) += weight * sampled(t, 3 + d);
      }
  }
  return strains;
}

CellStrain ShellOperator::strains_at(std::size_t cell, const element::CellField& field, const element::BasisAt& basis,
                                     const std::vector<MatrixXd>& tied, std::span<const geometry::Frame> frames,
                                     const element::CellField* state) const {
  PLASTRON_ASSERT(frames.size() == basis.xi.size() && (tied.empty() || tied.size() == tables_.samplings.size()),
                  frames.size(), basis.xi.size(), tied.size(), tables_.samplings.size());
  CellStrain strains = CellStrain::Zero(basis.value.rows(), 8);
  const auto bases = interpolation_.bases(cell, basis.xi);
  const element::FieldRows rows = interpolation_.fields(cell, basis, bases, field);
  std::optional<element::FieldRows> moved;
  if (state) moved = interpolation_.fields(cell, basis, bases, *state);
  std::optional<element::FieldRows> interpolated;
  if (reference_.layout()) interpolated = interpolation_.fields(cell, basis, bases, gather(cell, reference_));
  for (Eigen::Index p = 0; p < strains.rows(); ++p) {
    const geometry::Frame& exact = frames[static_cast<std::size_t>(p)];
    const geometry::Frame reference = interpolated ? shell::replaced(exact, interpolated->at(p)) : exact;
    const geometry::Frame frame = moved ? shell::deformed(reference, moved->at(p)) : reference;
    strains.row(p).segment<3>(3) = shell::bending_strain(rows.at(p), frame);
    if (tables_.tying) continue;
    strains.row(p).head<3>() = shell::membrane_strain(rows.at(p), frame.a_cov);
    strains.row(p).tail<2>() = shell::shear_strain(rows.at(p), frame.a_cov, frame.a3);
  }
  CellGeometry at;
  if (!tied.empty()) at = state ? geometry(cell, *state) : geometry(cell);
  for (std::size_t s = 0; s < tied.size(); ++s) {
    const SampledStrain at_points = tied[s] * sampled_strains(s, cell, field, at);
    for (const int m : tables_.samplings[s].membrane) strains.col(m) = at_points.col(m);
    for (const int d : tables_.samplings[s].shear) strains.col(6 + d) = at_points.col(3 + d);
  }
  return strains;
}

CellStrain ShellOperator::weighted_stresses(std::size_t cell, const CellStrain& strains) const {
  PLASTRON_ASSERT(strains.rows() == tables_.points_per_cell(), strains.rows(), tables_.points_per_cell());
  CellStrain stresses(strains.rows(), 8);
  for (int q = 0; q < tables_.points_per_cell(); ++q) {
    const QuadraturePoint p = point(cell, q);
    stresses.row(q) = p.area * p.section.resultants_of(strains.row(q).transpose());
  }
  return stresses;
}

Eigen::MatrixX2d ShellOperator::values_of(const Temperature& temperature, std::size_t cell,
                                          const std::vector<Vector2d>& xi) const {
  Eigen::MatrixX2d values(static_cast<Eigen::Index>(xi.size()), 2);
  surface_->evaluate(temperature.mean, space_->cells[cell], xi, {values.col(0).data(), xi.size()});
  surface_->evaluate(temperature.difference, space_->cells[cell], xi, {values.col(1).data(), xi.size()});
  return values;
}

namespace {

/// Returns the sum of temperatures times their factors at a point.
shell::InitialState initial_state(const CrossSection& section, const std::vector<Eigen::MatrixX2d>& temperatures,
                                  Eigen::Index point, const Factors& factors) {
  shell::InitialState state{.strains = factors.loads};
  for (std::size_t k = 0; k < temperatures.size(); ++k) {
    const double factor = factors.load(section.temperatures[k].factor);
    state.temperature += factor * temperatures[k](point, 0);
    state.difference += factor * temperatures[k](point, 1);
  }
  return state;
}

}  // namespace

std::vector<shell::InitialState> ShellOperator::initial_states(std::size_t cell, const std::vector<Vector2d>& xi,
                                                               const Factors& factors) const {
  const CrossSection& own = section(cell);
  std::vector<Eigen::MatrixX2d> temperatures;
  for (const Temperature& temperature : own.temperatures) temperatures.push_back(values_of(temperature, cell, xi));
  std::vector<shell::InitialState> states;
  for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(xi.size()); ++p)
    states.push_back(initial_state(own, temperatures, p, factors));
  return states;
}

std::optional<CellStrain> ShellOperator::weighted_initial_stresses(std::size_t cell, const Factors& factors) const {
  const CrossSection& own = section(cell);
  if (!own.has_initial_strains()) return {};
  CellStrain stresses(tables_.points_per_cell(), 8);
  for (int q = 0; q < tables_.points_per_cell(); ++q) {
    const QuadraturePoint p = point(cell, q);
    auto state =
        initial_state(own, temperatures_.empty() ? std::vector<Eigen::MatrixX2d>{} : temperatures_[cell], q, factors);
    const Eigen::Matrix2d b = geometry::curvature(p.frame);
    state.curvature = {b(0, 0), b(1, 1), 2 * b(0, 1)};
    stresses.row(q) = p.area * shell::section_at(own.material, p.frame, p.thickness, state).initial_resultants();
  }
  return stresses;
}

std::optional<CellStrain> ShellOperator::initial_strains(std::size_t cell, const Factors& factors) const {
  auto strains = weighted_initial_stresses(cell, factors);
  for (int q = 0; strains && q < tables_.points_per_cell(); ++q) {
    const QuadraturePoint p = point(cell, q);
    strains->row(q) = p.section.strains_of(strains->row(q).transpose() / p.area).transpose();
  }
  return strains;
}

ShellOperator::SampledStrain ShellOperator::sampled_stresses(std::size_t s, const CellStrain& stresses) const {
  const element::Sampling& sampling = tables_.samplings[s];
  SampledStrain sampled = SampledStrain::Zero(static_cast<Eigen::Index>(sampling.basis.xi.size()), 5);
  for (int q = 0; q < tables_.points_per_cell(); ++q)
    for (const auto& [t, weight] : sampling.to_quadrature[static_cast<std::size_t>(q)]) {
      for (const int m : sampling.membrane) sampled(t, m) += weight * stresses(q, m);
      for (const int d : sampling.shear) sampled(t, 3 + d) += weight * stresses(q, 6 + d);
    }
  return sampled;
}

element::CellField ShellOperator::forces(std::size_t cell, const CellStrain& stresses,
                                         const CellGeometry& geometry) const {
  PLASTRON_ASSERT(stresses.rows() == tables_.points_per_cell(), stresses.rows(), tables_.points_per_cell());
  element::CellField forces = element::CellField::Zero(tables_.nodes_per_cell(), 6);
  element::FieldRows bending = element::FieldRows::zero(tables_.points_per_cell());
  for (int q = 0; q < tables_.points_per_cell(); ++q) {
    LocalField<double> dual = shell::zero_field();
    shell::add_bending_dual(stresses.row(q).segment<3>(3), geometry.frames[static_cast<std::size_t>(q)], dual);
    bending.add_dual(q, dual);
  }
  interpolation_.add_forces(cell, tables_.quadrature, quadrature_bases(cell), std::move(bending), forces);

  for (std::size_t s = 0; s < tables_.samplings.size(); ++s) {
    const SampledStrain sampled = sampled_stresses(s, stresses);
    element::FieldRows rows = element::FieldRows::zero(sampled.rows());
    for (Eigen::Index t = 0; t < sampled.rows(); ++t) {
      const SamplingPoint& at = geometry.samplings[s][static_cast<std::size_t>(t)];
      LocalField<double> dual = shell::zero_field();
      shell::add_membrane_dual(sampled.row(t).head<3>(), at.a_cov, dual);
      shell::add_shear_dual(sampled.row(t).tail<2>(), at.a_cov, at.a3, dual);
      rows.add_dual(t, dual);
    }
    interpolation_.add_forces(cell, tables_.samplings[s].basis, sampling_bases(s, cell), std::move(rows), forces);
  }
  return forces;
}

RowMatrix ShellOperator::strain_matrix(std::size_t cell, const CellGeometry& geometry) const {
  const int columns = 6 * tables_.nodes_per_cell();
  RowMatrix b = RowMatrix::Zero(8 * tables_.points_per_cell(), columns);
  Eigen::RowVectorXd row(columns);
  for (int q = 0; q < tables_.points_per_cell(); ++q) {
    const Frame& frame = geometry.frames[static_cast<std::size_t>(q)];
    for (int c = 0; c < 3; ++c) {
      LocalField<double> dual = shell::zero_field();
      shell::add_bending_dual(Vector3d::Unit(c), frame, dual);
      interpolation_.write_row(cell, tables_.quadrature, q, quadrature_bases(cell), dual, row);
      b.row(8 * q + 3 + c) = row;
    }
  }
  for (std::size_t s = 0; s < tables_.samplings.size(); ++s) {
    const element::Sampling& sampling = tables_.samplings[s];
    std::vector<RowMatrix> sampled(sampling.membrane.size() + sampling.shear.size(),
                                   RowMatrix(static_cast<Eigen::Index>(sampling.basis.xi.size()), columns));
    std::vector<int> component(sampling.membrane);
    for (const int d : sampling.shear) component.push_back(6 + d);
    for (Eigen::Index t = 0; t < sampled[0].rows(); ++t)
      for (std::size_t k = 0; k < component.size(); ++k) {
        const SamplingPoint& at = geometry.samplings[s][static_cast<std::size_t>(t)];
        LocalField<double> dual = shell::zero_field();
        if (component[k] < 3)
          shell::add_membrane_dual(Vector3d::Unit(component[k]), at.a_cov, dual);
        else
          shell::add_shear_dual(Eigen::Vector2d::Unit(component[k] - 6), at.a_cov, at.a3, dual);
        interpolation_.write_row(cell, sampling.basis, t, sampling_bases(s, cell), dual, row);
        sampled[k].row(t) = row;
      }
    for (int q = 0; q < tables_.points_per_cell(); ++q)
      for (const auto& [t, weight] : sampling.to_quadrature[static_cast<std::size_t>(q)])
        for (std::size_t k = 0; k < component.size(); ++k) b.row(8 * q + component[k]) += weight * sampled[k].row(t);
  }
  return b;
}

void ShellOperator::scatter(std::size_t cell, const element::CellField& forces, algebra::Vector& f) const {
  assert_is_field(f, "scattered to");
  PLASTRON_ASSERT(forces.rows() == tables_.nodes_per_cell(), forces.rows(), tables_.nodes_per_cell());
  const auto nodes = space_->nodes(cell);
  const auto out = f.local();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int k = 0; k < 6; ++k)
      out[static_cast<std::size_t>(nodes[i]) * 6 + static_cast<std::size_t>(k)] +=
          forces(static_cast<Eigen::Index>(i), k);
}

void ShellOperator::apply(const algebra::Vector& y, algebra::Vector& f) const {
  PLASTRON_ASSERT(algebra::ghosts_are_current(y), "update_ghosts() before apply()");
  f.fill(0);
  add_product(y, f);
  f.accumulate_ghosts();
}

void ShellOperator::add_product(const algebra::Vector& y, algebra::Vector& f) const {
  assert_is_field(y, "multiplied");
  assert_is_field(f, "to be the product");
  if (has_packed_strains())
    kernels().add_product(packed(), y.local().data(), f.local().data());
  else
    for (std::size_t c = 0; c < space_->owned_cells; ++c)
      scatter(c, forces(c, weighted_stresses(c, strains(c, gather(c, y)))), f);
}

Energies ShellOperator::energies_of(const std::function<CellStrain(std::size_t)>& strains_at) const {
  Energies sum;
  for (std::size_t c = 0; c < space_->owned_cells; ++c) {
    const CellStrain s = strains_at(c);
    for (int q = 0; q < tables_.points_per_cell(); ++q) {
      const QuadraturePoint p = point(c, q);
      const shell::Strain<double> strain{s.row(q).head<3>(), s.row(q).segment<3>(3), s.row(q).tail<2>()};
      const shell::EnergyDensity density = shell::energy_density(p.section, strain);
      sum.membrane += p.area * density.membrane;
      sum.bending += p.area * density.bending;
      sum.shear += p.area * density.shear;
    }
  }
  return over_ranks(sum, space_->layout->comm);
}

Energies ShellOperator::energies(const algebra::Vector& y) const {
  PLASTRON_ASSERT(algebra::ghosts_are_current(y), "update_ghosts() before energies()");
  assert_is_field(y, "asked for its energy");
  if (!has_packed_strains()) return energies_of([&](std::size_t cell) { return strains(cell, gather(cell, y)); });
  const PackEnergies packs = kernels().energies(packed(), y.local().data());
  return over_ranks({.membrane = packs.membrane, .bending = packs.bending, .shear = packs.shear}, space_->layout->comm);
}

}  // namespace plastron::energy
