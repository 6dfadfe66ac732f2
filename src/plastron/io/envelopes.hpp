// Envelopes of load cases: the least and the largest value of each number and of each field, and the case that has it.
#pragma once
#include <plastron/io/quantities.hpp>
#include <plastron/io/vtu.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace plastron::io {

/// Returns one record for each of `envelopes`, the effective settings of [[envelope]]: its name, and under "numbers" for each path inside
/// a record of `history` the least and the largest value with their cases.
Json envelopes_json(const Json& history, const Json& envelopes);

/// Returns the points of the undeformed mid-surface with the fields of a load case that an envelope can have: not directions, and
/// nothing of the undeformed shell. `choice` gives heights and names of units.
GridPiece case_piece(const computation::Solution& solution, VtuChoice choice);

/// An envelope of fields, point by point. Components of vectors are compared one by one.
class EnvelopeFields {
 public:
  explicit EnvelopeFields(problem::Envelope envelope) : envelope_(std::move(envelope)) {}

  /// Adds the case_piece() of a load case, if the envelope has this case (collective).
  void add(const std::string& load_case, const GridPiece& fields, MPI_Comm comm);
  /// Whether all cases were added, on one mesh.
  bool is_complete() const { return added_ == envelope_.cases.size() && has_one_mesh_; }
  /// Whether cases were added on different meshes, so that there are no fields.
  bool has_several_meshes() const { return !has_one_mesh_; }
  const std::string& name() const { return envelope_.name; }
  /// Returns, for each field, arrays NAME_least, NAME_least_case, NAME_largest, NAME_largest_case. Cases are places in the list of the
  /// envelope, from 0, and -1 where the field has no value.
  const GridPiece& piece() const { return piece_; }
  /// Returns "envelope-NAME.vtu".
  std::string file_name() const { return "envelope-" + envelope_.name + ".vtu"; }

 private:
  problem::Envelope envelope_;
  std::size_t added_ = 0;
  bool has_one_mesh_ = true;
  GridPiece piece_{};
};

/// Whether the file of an envelope may have such a name.
inline bool is_envelope_name(std::string_view name) { return name.starts_with("envelope-") && name.ends_with(".vtu"); }

}  // namespace plastron::io
