// The motions that hinges leave free. Each piece of the shell between hinges moves as a rigid body, six coefficients for each; supports,
// terms of the potential, contact and the displacement that pieces share at a hinge resist.
#include <plastron/examination/rigid_motions.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace plastron::examination {

namespace {

using Eigen::Index, Eigen::MatrixXd;

/// Returns an orthonormal basis of the eigenvectors with eigenvalues above a limit, or of the others.
MatrixXd eigenvectors(const MatrixXd& gram, double limit, bool are_above) {
  const auto eigen = geometry::symmetric_eigen(gram);
  const Index below = (eigen.values.array() < limit).count();
  return are_above ? eigen.vectors.rightCols(gram.cols() - below) : eigen.vectors.leftCols(below);
}

/// The stiffness that resists motions of pieces.
class Resistance {
 public:
  Resistance(const RigidMotions& motions, const std::vector<ShellPart>& pieces,
             const assembly::NodalCoordinates& coordinates)
      : motions_(motions),
        pieces_(pieces),
        coordinates_(coordinates),
        gram_(MatrixXd::Zero(6 * static_cast<Index>(pieces.size()), 6 * static_cast<Index>(pieces.size()))) {
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (std::size_t i = 0; i < pieces[p].nodes.size(); ++i) places_[pieces[p].nodes[i]] = {p, i};
  }

  void add_supports_and_contact() {
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      auto own = gram_.block<6, 6>(at(p), at(p));
      for (const auto* body : pieces_[p].bodies) own += motions_.fixed_by(body->body);
      for (std::size_t i = 0; i < pieces_[p].nodes.size(); ++i) {
        const std::size_t node = pieces_[p].nodes[i];
        const auto motion = motions_.at(pieces_[p].points[i]);
        const auto add = [&](const RigidMotion& row) { own += row * row.transpose(); };
        for (int k = 0; k < coordinates_.width; ++k)
          if (coordinates_.is_prescribed(node, k)) add(motion.transpose() * coordinates_.direction(node, k));
        for (const auto& gaps : coordinates_.gaps) add(motions_.gap_change(pieces_[p].points[i], gaps[node]));
      }
    }
  }

  /// Adds a term, as a part of its largest entry.
  void add_term(const energy::Term& term, const energy::ShellOperator& shell) {
    MatrixXd all = MatrixXd::Zero(gram_.rows(), gram_.cols());
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (int k = 0; k < 6; ++k) {
        const algebra::Vector forces = motions_.forces_of(term, shell, pieces_[p], k);
        for (std::size_t q = 0; q < pieces_.size(); ++q)
          all.block<6, 1>(at(q), at(p) + k) = motions_.work(pieces_[q], forces.local());
      }
    const double largest = all.diagonal().maxCoeff();
    if (largest > 0) gram_ += static_cast<double>(places_.size()) / largest * all;
  }

  /// Adds the equal displacements of pieces at hinges. Returns the pairs of pieces.
  std::set<std::pair<std::size_t, std::size_t>> add_hinges() {
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const constraints::Row& row : coordinates_.space->constraints.rows())
      for (const constraints::Term& term : row.terms) {
        const auto one = places_.find(static_cast<std::size_t>(row.node)),
                   other = places_.find(static_cast<std::size_t>(term.node));
        if (one == places_.end() || other == places_.end() || one->second.first == other->second.first) continue;
        const auto [p, i] = one->second;
        const std::size_t q = other->second.first;
        const auto u = motions_.at(pieces_[p].points[i]).topRows<3>().eval();
        const Eigen::Matrix<double, 6, 6> both = u.transpose() * u;
        gram_.block<6, 6>(at(p), at(p)) += both;
        gram_.block<6, 6>(at(q), at(q)) += both;
        gram_.block<6, 6>(at(p), at(q)) -= both;
        gram_.block<6, 6>(at(q), at(p)) -= both;
        pairs.insert(std::minmax(p, q));
      }
    return pairs;
  }

  /// Returns a basis of the motions that nothing resists, up to motions of all pieces together.
  MatrixXd free() const {
    constexpr double resisted = 1e-10, apart = 1e-8;
    const double largest = std::max(1.0, gram_.diagonal().maxCoeff());
    MatrixXd all = eigenvectors(gram_, resisted * largest, false);
    if (all.cols() == 0) return all;
    const MatrixXd together = MatrixXd::Identity(6, 6).replicate(static_cast<Index>(pieces_.size()), 1) /
                              std::sqrt(static_cast<double>(pieces_.size()));
    const MatrixXd relative = all - together * (together.transpose() * all);
    return all * eigenvectors(relative.transpose() * relative, apart, true);
  }

  static Index at(std::size_t piece) { return 6 * static_cast<Index>(piece); }

 private:
  const RigidMotions& motions_;
  const std::vector<ShellPart>& pieces_;
  const assembly::NodalCoordinates& coordinates_;
  MatrixXd gram_;
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> places_{};  // piece, and index there, of each node
};

}  // namespace

std::vector<RigidMotion> free_hinge_motions(const RigidMotions& motions, const std::vector<ShellPart>& pieces,
                                            const assembly::NodalCoordinates& coordinates,
                                            const energy::ShellOperator& shell, const energy::Terms& terms) {
  constexpr double moves = 1e-8;
  Resistance resistance(motions, pieces, coordinates);
  resistance.add_supports_and_contact();
  for (const auto& term : terms) resistance.add_term(*term, shell);
  const auto pairs = resistance.add_hinges();
  const MatrixXd free = resistance.free();
  std::vector<RigidMotion> all;
  if (free.cols() == 0) return all;
  for (const auto& [p, q] : pairs) {
    const MatrixXd relative = free.middleRows<6>(Resistance::at(q)) - free.middleRows<6>(Resistance::at(p));
    const std::vector<RigidMotion> own = readable(eigenvectors(relative * relative.transpose(), moves, true));
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace plastron::examination
