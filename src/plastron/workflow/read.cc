#include <plastron/workflow/read.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/computation/sensitivity.hpp>
#include <plastron/config/printable.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/energy/load_vector.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/geometry/given_function.hpp>
#include <plastron/io/mode_file.hpp>
#include <plastron/mesh/surface_patches.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/problem/edge_contact.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <utility>

namespace plastron::workflow {

namespace {

// Packs findings so that the first rank can send them: for each a letter for its severity, its text and a zero.
std::string in_one_text(const std::vector<examination::Finding>& findings) {
  std::string all;
  for (const examination::Finding& finding : findings) {
    all += static_cast<char>('0' + static_cast<int>(finding.severity));
    all += finding.text;
    all += '\0';
  }
  return all;
}

std::vector<examination::Finding> from_one_text(const std::string& all) {
  std::vector<examination::Finding> findings;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = all.find('\0', at);
    findings.push_back({static_cast<examination::Severity>(all[at] - '0'), all.substr(at + 1, end - at - 1)});
    at = end + 1;
  }
  return findings;
}

/// Reads the modes of imperfections, every rank by itself.
void read_modes(problem::Problem& problem) {
  const auto* file = std::get_if<domain::MeshFile>(&problem.domain);
  if (file && file->in_space && !file->mesh) return;  // the mesh is wrong, and the examination says why
  const std::size_t patches = file && file->in_space ? file->mesh->patches->patches.size() : 0;
  for (problem::Imperfection& imperfection : problem.imperfections)
    if (!imperfection.mode_file.empty())
      imperfection.shift = io::read_mode(imperfection.mode_file, imperfection.amplitude, patches);
}

/// Shows the corners of the shell's cells to the functions that the case names. What is wrong with them or with the mesh, the
/// examination and the solution report.
void show_shell(const config::Case& c) {
  try {
    auto coarse =
        std::make_shared<const mesh::CoarseMesh>(domain::coarse_mesh(c.problem.domain, c.problem.discretisation.cells));
    const fem::Surface surface(coarse, c.problem.charts);
    const std::vector<Eigen::Vector2d> corners = mesh::lattice(coarse->shape, 1);
    std::vector<geometry::Place> places;
    for (std::size_t cell = 0; cell < coarse->cells.size(); ++cell)
      std::ranges::copy(surface.places({.coarse = static_cast<int>(cell)}, corners, true), std::back_inserter(places));
    geometry::show_places(c.text, places);
  } catch (const mesh::DomainError&) {
  } catch (const geometry::FunctionError&) {
  }
}

template <class... Errors>
bool is_one_of(const std::exception& error) {
  return (... || (dynamic_cast<const Errors*>(&error) != nullptr));
}

RefusedCase refused(const std::exception& error) {
  return RefusedCase(fmt::format("error: {}\n", config::printable(std::string_view(error.what()))));
}

}  // namespace

void refusing(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    if (!is_one_of<mesh::DomainError, assembly::SupportError, obstacle::ObstacleError, energy::LoadError,
                   geometry::FunctionError, computation::SensitivityError>(error))
      throw;
    throw refused(error);
  }
}

config::Case read_together(const std::function<config::Case()>& read, MPI_Comm comm) {
  config::Case c = algebra::in_agreement<RefusedCase>(comm, [&] {
    try {
      return read();
    } catch (const config::CaseErrors& errors) {
      throw RefusedCase(errors.format());
    }
  });
  c.problem.domain = domain::with_shared_mesh(std::move(c.problem.domain), c.problem.discretisation.cells, comm);
  algebra::in_agreement<RefusedCase>(comm, [&] {
    try {
      read_modes(c.problem);
    } catch (const io::UnusableResults& error) {
      throw refused(error);
    }
  });
  try {
    problem::locate_points(c.problem);
    if (geometry::has_given_functions()) show_shell(c);
    problem::let_both_faces_touch(c.problem);
  } catch (const mesh::DomainError&) {        // the examination and the solution report what is wrong with the mesh
  } catch (const geometry::FunctionError&) {  // and with functions
  }
  return c;
}

std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination, MPI_Comm comm) {
  const auto mine = algebra::in_agreement<mesh::DomainError, obstacle::ObstacleError>(
      comm, [&] { return algebra::rank_in(comm) == 0 ? examination() : std::vector<examination::Finding>{}; });
  return from_one_text(algebra::first_words(in_one_text(mine), comm));
}

const char* to_string(examination::Severity severity) {
  switch (severity) {
    case examination::Severity::error:
      return "error";
    case examination::Severity::warning:
      return "warning";
    case examination::Severity::note:
      break;
  }
  return "note";
}

io::CaseSource source_of(const config::Case& c, const std::filesystem::path& case_file,
                         const std::vector<std::string>& settings, MPI_Comm comm) {
  auto source = algebra::in_agreement(comm, [&] { return io::case_source(case_file, c.text, c.files); });
  source.settings = settings;
  return source;
}

std::vector<std::filesystem::path> inputs_of(const config::Case& c, const std::filesystem::path& case_file) {
  std::vector<std::filesystem::path> inputs{case_file};
  for (const auto& [name, path] : c.files) inputs.push_back(path);
  return inputs;
}

}  // namespace plastron::workflow
