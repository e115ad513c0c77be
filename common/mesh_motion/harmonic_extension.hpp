#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "algebra/csr_matrix.hpp"
#include "fem/nodal_frames.hpp"
#include "fem/nodal_layout.hpp"
#include "linear/amg/scalar_multigrid.hpp"
#include "linear/direct/shared_cholesky.hpp"
#include "mesh_motion/follower_elimination.hpp"
#include "mesh_motion/mesh_extension.hpp"
#include "parallel/node_share.hpp"

namespace fsi {

/// How a harmonic extension is computed. Defaults by measurement (docs/archive.md).
struct HarmonicExtensionOptions {
  /// Inner nodes without followers, of the process with the most of them, from which the iteration serves; without it
  /// SolverPolicy decides. On several processes a large separator (SharedCholesky) also calls for the iteration.
  std::optional<int> iterative_from;
  double tolerance = 1e-12;  ///< of the iteration: its residual over that of zero inner values
  int max_iterations = 100;  ///< of conjugate gradients; a solve that needs more falls back to a factorisation
  /// Factors are kept in single precision where they serve: for callers that ask for a few digits. More digits are
  /// reached by corrections.
  bool single_precision = false;
};

/// The mesh motion's equations. Components do not couple: each distinct one has a scalar matrix, whose components are
/// solved at once, by a factorisation or, where that is large, by conjugate gradients in double precision around a
/// V-cycle of smoothed aggregation in single precision. Nodes that follow two others at most, as those in the middle of
/// edges, are eliminated before. Components that frames of nodes mix have one matrix together.
/// Results do not depend on the number of threads. Processes that share the nodes solve together, each with the rows of its
/// own nodes (SharedCholesky, or the iteration); frames must not mix components there.
/// \tparam n  components of a node
template <int n>
class HarmonicExtension : public MeshExtension<n> {
 public:
  /// \param laplacian  symmetric, one number per node pair and component, conditions not imposed; must outlive this
  /// \param inner      per node and component: its value is sought, its row an equation
  /// \param frames     of nodes whose components, in all vectors and in `inner`, are those of a frame; must outlive this;
  ///                   null: none
  HarmonicExtension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner,
                    const HarmonicExtensionOptions& options = {}, const NodalFrames<n>* frames = nullptr);
  /// Of nodes that processes share. Right sides count at own entries; fields hold ghosts: given values have to be in them,
  /// sought ones are brought to them.
  /// \param inner   at ghosts it does not matter
  /// \param share   must outlive this
  /// \param rescue  makes the solver to fall back to where the iteration fails; its update() is called before it solves
  HarmonicExtension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner, const NodalFrames<n>* frames,
                    const NodeShare& share, std::function<std::unique_ptr<MeshExtension<n>>()> rescue,
                    const HarmonicExtensionOptions& options = {});
  /// Whether a frame turns some component out of its axis. \param frames  null: none
  static bool mixes(const NodalFrames<n>* frames);
  /// The operator has new values.
  /// \throws ConvergenceError when it is singular
  void update() override;

  /// Sets the inner values of `field`, n numbers a node, so that the rows of A field at inner entries equal `right`
  /// there; the other values are given. The iteration starts from the inner values as they are.
  /// \param tolerance  in place of the options' one; factors in double precision solve to rounding
  void solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) override;
  void solve(const std::vector<double>& right, std::vector<double>& field) { solve(right, field, options_.tolerance); }

  /// All components are solved by iteration.
  bool iterates() const override;
  double memory_mib() const override;
  /// Conjugate gradient iterations of the last solve, the most of all components.
  int iterations() const override { return iterations_; }

 private:
  /// Components of one matrix: several that have the same, or several that frames mix, each with rows of its own.
  struct Group {
    std::vector<int> components;
    bool mixed = false;
    std::vector<int> row;             ///< per entry of the vector layout; -1 where the value is given
    std::vector<std::size_t> entry;   ///< per row, of the first of its vectors; rows of ghosts behind
    int own = 0;                      ///< rows
    bool anywhere = true;             ///< some process has rows
    std::vector<std::size_t> offset;  ///< from there to the entry of each of its vectors
    FollowerElimination followers;    ///< what is solved for is without them
    CsrMatrix<double> matrix;         ///< of what is kept, for the iteration
    ShareOfNumbers share;             ///< of its rows and columns
    ScalarMultigrid multigrid;        ///< its preconditioner
    SharedCholesky solver;
    bool iterative = false;
  };

  /// Sorts the components into groups by their present numbers and makes each group's solver.
  void build_groups();
  bool same(int i, int k) const;
  /// Some frame is turned out of this component's axis.
  static bool is_mixed(const NodalFrames<n>& frames, int component);
  bool owns(std::size_t node) const { return !nodes_ || nodes_->owned[node] != 0; }
  const Communicator& processes() const { return nodes_ ? *nodes_->processes : Communicator::alone(); }
  /// Those of all processes have the owners' values.
  void update_ghosts(std::vector<double>& field) const {
    if (nodes_) nodes_->template update<VectorLayout<n>>(field);
  }
  void set_up(Group& group);
  /// Of a matrix with rows of ghosts: per row.
  std::vector<char> find_followers(const Group& group, const CsrMatrix<double>& a) const;
  ShareOfNumbers share_of_kept(const Group& group) const;
  /// Whether a group is iterated for. \param a  of what is kept
  bool decide_to_iterate(const Group& group, const CsrMatrix<double>& a) const;
  /// Calls visit(column, value) for the entries of a row of the group's matrix, columns ascending.
  template <class Visit>
  void for_row(const Group& group, std::size_t row, Visit visit) const;
  /// Fills beside_given_ and what goes with it, but for numbers.
  void find_couplings_to_given();
  /// rows_ = A values_, in the frames.
  void apply_operator();
  /// The same where inner values are zero.
  void apply_operator_to_given();
  /// Makes balance_, where processes share the nodes: right - rows_, of copies, too.
  void balance(const std::vector<double>& right);
  /// right_ = right - rows_ in the group's rows, one component behind the other.
  void take(const Group& group, const std::vector<double>& right);
  /// Inner values of `field` in the group's rows += those that solve for right - rows_.
  void add_solution(const Group& group, const std::vector<double>& right, std::vector<double>& field);
  /// kept_ of own unknowns becomes that of copies, too.
  void add_copies(const Group& group);
  /// Corrects what factors in single precision have solved until the residual is as small as is demanded, or all that is
  /// left is rounding. \param reference  the residual of zero inner values
  void refine(const std::vector<double>& right, std::vector<double>& field, double tolerance, double reference);
  /// |right - rows_| over inner entries of groups whose factors are in single precision.
  double residual(const std::vector<double>& right) const;
  template <int m>
  bool iterate(Group& group, const std::vector<double>& right, std::vector<double>& field, double tolerance);

  const BlockMatrix<1, n>& laplacian_;
  std::vector<char> inner_;
  HarmonicExtensionOptions options_;
  const NodalFrames<n>* frames_;
  const NodeShare* nodes_ = nullptr;  ///< null: all are here
  std::function<std::unique_ptr<MeshExtension<n>>()> make_rescue_;
  std::unique_ptr<MeshExtension<n>> rescue_;  ///< of the present operator; null: the iteration served so far
  std::vector<Group> groups_;
  /// A node of which some component is given, and the numbers by which another one's rows, or its own, know it: a copy, for
  /// they lie far apart in the matrix.
  struct Coupling {
    int column;
    double numbers[n];
  };
  std::vector<int> beside_given_;      ///< nodes whose rows have such couplings
  std::vector<int> coupling_offsets_;  ///< per such node, into the list that follows
  std::vector<Coupling> couplings_;
  std::vector<int> blocks_;  ///< of the matrix, that these are copies of
  int iterations_ = 0;
  std::vector<double> values_, rows_, right_, right_of_kept_, kept_, solution_, balance_, exchanged_;
};

}  // namespace fsi
