#include "linear/direct/dense_inverse.hpp"

#include <Eigen/Dense>
#include <cassert>

namespace fsi {

std::vector<double> dense_inverse(const std::vector<double>& matrix, int rows) {
  assert(matrix.size() == static_cast<std::size_t>(rows) * rows);
  const Eigen::MatrixXd inverse = Eigen::Map<const Eigen::MatrixXd>(matrix.data(), rows, rows).partialPivLu().inverse();
  if (!inverse.allFinite()) return {};
  return {inverse.data(), inverse.data() + inverse.size()};
}

}  // namespace fsi
