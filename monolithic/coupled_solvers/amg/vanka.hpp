#pragma once

#include <vector>

#include "monolithic/coupled_solvers/amg/saddle_smoother.hpp"

namespace fsi {

/// How a patch problem is solved.
enum class VankaPatch {
  diagonal,  ///< velocities of different nodes do not couple in the patch: n x n blocks and one Schur complement number
  full       ///< the dense patch matrix; its inverses take (n neighbours + 1)^2 numbers a node
};

struct VankaOptions {
  VankaPatch patch = VankaPatch::diagonal;
  double scaling = 1.0;  ///< factor of the diagonal blocks (diagonal patches)
  double damping = 1.0;  ///< of a patch correction
};

/// Multiplicative Vanka smoother [Vanka1986]: for each node the scalar unknown and the vectors of all nodes it couples
/// with are corrected together, with the residual at that moment. The residual is kept up to date, so that a patch
/// costs its own neighbourhood. Serial: patches overlap too much to be coloured.
template <int Size>
class Vanka : public SaddleSmoother<Size> {
 public:
  using Matrix = typename SaddleSmoother<Size>::Matrix;
  static constexpr int n = Size - 1;

  Vanka(const Matrix& a, const VankaOptions& options);
  void update(const Matrix& a) override;
  void smooth(const Matrix& a, const std::vector<double>& b, std::vector<double>& x, int steps, bool backward,
              bool from_zero) override;
  std::size_t bytes() const override;

 private:
  void correct_patch(const Matrix& a, int node, std::vector<double>& x);

  VankaOptions options_;
  const NodeGraph& graph_;
  std::vector<int> diagonal_, transposed_;  ///< positions
  std::vector<double> block_inverse_;       ///< of diagonal blocks, n x n per node
  std::vector<double> schur_inverse_;       ///< per patch
  std::vector<std::size_t> patch_offsets_;  ///< into patches_
  std::vector<float> patches_;              ///< inverses of full patches
  std::vector<double> residual_;
  std::vector<double> right_, change_;  ///< of one patch
};

}  // namespace fsi
