#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "case/fast_options.hpp"
#include "linear/interface/linear_solver.hpp"
#include "linear/velocity_pressure/jacobian_policy.hpp"
#include "mesh_motion/mesh_extension.hpp"

namespace fsi {

/// Makers of what FastSolver needs where several processes share a scene. Empty ones: FastSolver makes what serves on
/// one process.
template <int n>
struct FastParts {
  using MakeSolver = std::function<std::unique_ptr<LinearSolver>(const JacobianBlocks<n>&)>;

  std::function<std::unique_ptr<MeshExtension<n>>(const JacobianBlocks<n>&, std::vector<char> inner)> extension;
  MakeSolver factors;  ///< of a system that is not iterated
  MakeSolver rescue;   ///< factors of one that defeats the iteration
};

/// `fast`: the linear solver that a user should run. What is known exactly is eliminated: the numbering holds one
/// velocity on the interface, and the mesh displacement follows from it by an extension (MeshExtension), whose matrix
/// is set up anew only when it changes. An outer iteration computes residuals of the whole system in double precision;
/// corrections come from GMRES in single precision for velocities and pressures of both media, preconditioned by a
/// FlowPreconditioner. Of the shape derivatives their matrix has those of InterfaceShapeDerivatives. The others, small
/// against the rest, come back through the residual. Small systems are factorised; so is one that defeats the
/// iteration, and a larger one in two dimensions whose wall is stiff. On several processes the same iteration runs on
/// all of them together, each with the rows of its own unknowns.
template <int n>
class FastSolver : public LinearSolver {
 public:
  explicit FastSolver(const JacobianBlocks<n>& blocks, const FastOptions& options = {});
  /// \param policy  decides in place of that of a system by itself
  /// \param parts   all of them where several processes share the scene
  FastSolver(const JacobianBlocks<n>& blocks, const FastOptions& options, JacobianPolicy<n> policy,
             FastParts<n> parts = {});

  ~FastSolver() override;

  const char* preparation() override;
  std::string decides() const override;
  bool ready() const override { return ready_; }

  /// What a failure led to is forgotten here: solutions depend on the Jacobian of the last update() alone, not on what
  /// was solved before it, as a restart needs.
  void update() override;

  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;
  LinearReport try_to_solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) override;

  double keep_contraction() const override;

  LinearStatistics statistics() const override;
  MediumPreconditioner* medium_preconditioner() override;
  bool is_iterative() const override { return iterative_ != nullptr; }

  /// The Jacobian is factorised: the system is small, its wall is stiff in two dimensions, or the iteration failed.
  bool uses_factorisation() const { return direct_ || factorised_; }

 private:
  /// \param strong  more sweeps, and coarse levels for the wall however stiff it is
  void set_up_preconditioner(bool strong);

  struct Iterative;
  struct Factorised;

  /// Of a system that is not iterated.
  void make_factors();
  void make_whole_factors();

  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x, bool may_factorise);

  /// Sets up what the present Jacobian is solved by, where that depends on its numbers.
  void choose();

  /// In the run's profile.
  void count(const char* event) const;

  LinearReport iterate(const std::vector<double>& b, double tolerance, std::vector<double>& x);

  JacobianBlocks<n> blocks_;
  FastOptions options_;
  JacobianPolicy<n> policy_;
  FastParts<n> parts_;
  std::unique_ptr<Iterative> iterative_;
  std::unique_ptr<Factorised> factorised_;  ///< of a plane system with a mesh motion
  std::unique_ptr<LinearSolver> direct_;    ///< of others, and where the other two do not serve
  bool ready_ = false;
  bool strengthened_ = false;  ///< the preconditioner, for a system that defeated the usual one
};

}  // namespace fsi
