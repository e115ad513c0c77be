#pragma once

#include <memory>
#include <vector>

#include "monolithic/coupled_solvers/amg/coarsening.hpp"
#include "monolithic/coupled_solvers/amg/coarsest.hpp"
#include "monolithic/coupled_solvers/amg/saddle_smoother.hpp"

namespace fsi {

/// What stands for A in the Schur complement and, without momentum sweeps, in the predictor.
enum class MomentumDiagonal {
  point,  ///< diagonal of A
  block   ///< diagonal blocks of the nodes
};

struct BraessSarazinOptions {
  MomentumDiagonal diagonal = MomentumDiagonal::block;
  /// Lower bound of Ahat_i / diag(A)_i taken from the row sum of A: for a mass matrix that is the lumped mass, which is
  /// right for smooth fields where the diagonal alone is 2.5 times too small.
  /// Off: measured, it makes the Schur complement of the fluid too small.
  bool row_sums = false;
  double scaling = 1.0;     ///< factor of Ahat
  int momentum_sweeps = 1;  ///< Gauss-Seidel sweeps as predictor; 0: u += Ahat^-1 (f - A u - G p), the classical choice
  int schur_sweeps = 2;     ///< symmetric Gauss-Seidel sweeps for the Schur complement
  double schur_relaxation = 1.0;  ///< over-relaxation of those sweeps (SSOR), below 2
  /// Entries of S below this share of the row's diagonal are lumped on it, for cheaper sweeps. Where C dominates S most
  /// of what nodes without a common cell contribute goes; too large a share makes S indefinite.
  double schur_drop = 0;
  /// S of at most so many nodes is factorised instead: where sweeps alone solve it too badly, and cheap on coarse
  /// levels.
  int schur_direct_nodes = 0;
  double damping = 1.0;  ///< of the pressure step
};

/// Braess-Sarazin smoother ([Braess1997]; inexact: [Zulehner2000]). One step:
///   u* = predictor(u; f - G p),   S q = g - D u* - E p  with  S = E - D Ahat^-1 G,
///   p += omega q,   u = u* - omega Ahat^-1 G q.
/// S is assembled; its few symmetric Gauss-Seidel sweeps are the inexactness. With Gauss-Seidel as predictor the step
/// is that of SIMPLE. Numbers are stored in single precision: they only shape a correction, and memory traffic is what
/// a sweep costs.
template <int Size>
class BraessSarazin : public SaddleSmoother<Size> {
 public:
  using Matrix = typename SaddleSmoother<Size>::Matrix;
  static constexpr int n = Size - 1;

  BraessSarazin(const Matrix& a, const BraessSarazinOptions& options);
  void update(const Matrix& a) override;
  void smooth(const Matrix& a, const std::vector<double>& b, std::vector<double>& x, int steps, bool backward,
              bool from_zero) override;
  std::size_t bytes() const override;

 private:
  using Real = float;

  void predict(const std::vector<double>& b, std::vector<double>& x, bool backward);
  void update_schur();
  void solve_schur(bool backward);

  BraessSarazinOptions options_;
  const NodeGraph& graph_;
  RowColours colours_, schur_colours_;
  std::vector<int> diagonal_;        ///< positions of the diagonal blocks
  std::vector<Real> momentum_;       ///< per block the columns of (A, G), padded with a zero to vector length
  std::vector<Real> continuity_;     ///< per block (D, E)
  std::vector<Real> gradient_;       ///< per block G
  std::vector<Real> block_inverse_;  ///< of A's diagonal blocks, for Gauss-Seidel
  std::vector<Real> hat_inverse_;    ///< Ahat^-1, n x n per node
  std::shared_ptr<const NodeGraph> schur_graph_;
  std::vector<int> schur_end_, schur_columns_;  ///< rows start as in the graph and end where dropping left them
  bool direct_;                                 ///< S is factorised, not swept
  std::vector<Real> schur_, schur_inverse_diagonal_;
  BlockMatrix<1, 1> schur_matrix_;  ///< S in double precision, for the factorisation
  CoarsestSolver<1> schur_solver_;
  std::vector<double> q_, schur_right_, predicted_;
};

}  // namespace fsi
