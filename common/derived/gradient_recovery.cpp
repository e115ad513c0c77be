#include "derived/gradient_recovery.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace fsi {

namespace {

constexpr int most_rings = 4;
// What is left of a column, relative, that the ones before it can all but make: rounding; and where a patch is thin.
constexpr double dependent = 1e-7, nearly_dependent = 0.1;

/// Nodes and cells of each other.
struct Neighbours {
  explicit Neighbours(const RecoveryCells& cells) : cells_(cells), offsets_(cells.points.size() + 1, 0) {
    for (const int node : cells.nodes) ++offsets_[static_cast<std::size_t>(node) + 1];
    for (std::size_t a = 1; a < offsets_.size(); ++a) offsets_[a] += offsets_[a - 1];
    cells_of_.resize(cells.nodes.size());
    auto next = offsets_;
    for (std::size_t i = 0; i < cells.nodes.size(); ++i)
      cells_of_[next[cells.nodes[i]]++] = i / static_cast<std::size_t>(cells.nodes_per_cell);
    seen_.assign(cells.points.size(), -1);
  }

  /// The nodes of all cells that touch `patch`, its own first.
  void grow(std::vector<int>& patch, int mark) {
    for (const int node : patch) seen_[node] = mark;
    const std::size_t known = patch.size();
    const auto count = static_cast<std::size_t>(cells_.nodes_per_cell);
    for (std::size_t i = 0; i < known; ++i)
      for (std::size_t k = offsets_[patch[i]]; k < offsets_[static_cast<std::size_t>(patch[i]) + 1]; ++k)
        for (std::size_t a = 0; a < count; ++a) {
          const int node = cells_.nodes[cells_of_[k] * count + a];
          if (seen_[node] == mark) continue;
          seen_[node] = mark;
          patch.push_back(node);
        }
  }

 private:
  const RecoveryCells& cells_;
  std::vector<std::size_t> offsets_, cells_of_;
  std::vector<int> seen_;  ///< per node, the last mark
};

/// Exponents of the monomials up to a degree: the constant, the coordinates in their order, then the others.
std::vector<std::array<int, 3>> monomials(int dim, int degree) {
  std::vector<std::array<int, 3>> all;
  for (int total = 0; total <= degree; ++total)
    for (int i = total; i >= 0; --i)
      for (int j = total - i; j >= 0; --j)
        if (const int k = total - i - j; dim == 3 || k == 0) all.push_back({i, j, k});
  return all;
}

/// Weights of the gradient at the first node of a patch; nothing when the patch does not determine the polynomial.
class Fit {
 public:
  Fit(const RecoveryCells& cells, int degree)
      : cells_(cells), dim_(static_cast<int>(cells.axes.size())), monomials_(monomials(dim_, degree)) {}

  /// \param reduced  whether monomials that the others can all but make on this patch are left out
  bool find(const std::vector<int>& patch, std::vector<std::array<double, 3>>& weights, bool reduced = false) {
    const std::size_t rows = patch.size(), columns = monomials_.size();
    if (rows < columns && !reduced) return false;
    const Point& centre = cells_.points[patch[0]];
    double scale = 0;  // so that powers are of one size
    nearest_ = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < rows; ++i) {
      double square = 0;
      for (const int axis : cells_.axes) square += std::pow(cells_.points[patch[i]][axis] - centre[axis], 2);
      scale = std::max(scale, std::sqrt(square));
      nearest_ = std::min(nearest_, std::sqrt(square));
    }
    q_.assign(rows * columns, 0.0);
    for (std::size_t i = 0; i < rows; ++i) {
      double power[3][4] = {{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
      for (int c = 0; c < dim_; ++c)
        for (int e = 1; e < 4; ++e)
          power[c][e] = power[c][e - 1] * (cells_.points[patch[i]][cells_.axes[c]] - centre[cells_.axes[c]]) / scale;
      for (std::size_t m = 0; m < columns; ++m)
        q_[m * rows + i] = power[0][monomials_[m][0]] * power[1][monomials_[m][1]] * power[2][monomials_[m][2]];
    }
    if (!orthogonalise(rows, columns, reduced)) return false;
    weights.assign(rows, {0, 0, 0});
    for (int c = 0; c < dim_; ++c) {
      // The coefficients are R^-1 Q^T f: row 1 + c of it, by forward substitution with R^T.
      std::vector<double> y(columns, 0.0);
      for (std::size_t m = 0; m < columns; ++m) {
        double sum = m == static_cast<std::size_t>(c) + 1 ? 1.0 : 0.0;
        for (std::size_t l = 0; l < m; ++l) sum -= r_[l * columns + m] * y[l];
        y[m] = r_[m * columns + m] > 0 ? sum / r_[m * columns + m] : 0;
      }
      for (std::size_t i = 0; i < rows; ++i) {
        double sum = 0;
        for (std::size_t m = 0; m < columns; ++m) sum += q_[m * rows + i] * y[m];
        weights[i][c] = sum / scale;
      }
    }
    return true;
  }

  /// Whether weights are as small as those of a difference quotient.
  bool is_determined(const std::vector<std::array<double, 3>>& weights) const {
    for (int c = 0; c < dim_; ++c) {
      double sum = 0;
      for (const auto& weight : weights) sum += std::abs(weight[c]);
      if (!(sum * nearest_ <= GradientRecovery::largest_weights)) return false;
    }
    return true;
  }

 private:
  /// Gram-Schmidt, each column twice: Q in q_, R in r_. False where a column depends on those before it; `reduced`: it is
  /// left out, zero in Q and on R's diagonal, unless it is linear.
  bool orthogonalise(std::size_t rows, std::size_t columns, bool reduced) {
    r_.assign(columns * columns, 0.0);
    for (std::size_t m = 0; m < columns; ++m) {
      double* column = &q_[m * rows];
      const double before = norm(column, rows);
      for (int pass = 0; pass < 2; ++pass)
        for (std::size_t l = 0; l < m; ++l) {
          const double* known = &q_[l * rows];
          double along = 0;
          for (std::size_t i = 0; i < rows; ++i) along += known[i] * column[i];
          for (std::size_t i = 0; i < rows; ++i) column[i] -= along * known[i];
          r_[l * columns + m] += along;
        }
      const double left = norm(column, rows);
      if (!(left > (reduced ? nearly_dependent : dependent) * before)) {
        if (!reduced || m <= static_cast<std::size_t>(dim_)) return false;
        std::fill_n(column, rows, 0.0);
        continue;
      }
      for (std::size_t i = 0; i < rows; ++i) column[i] /= left;
      r_[m * columns + m] = left;
    }
    return true;
  }
  static double norm(const double* x, std::size_t size) {
    double square = 0;
    for (std::size_t i = 0; i < size; ++i) square += x[i] * x[i];
    return std::sqrt(square);
  }

  const RecoveryCells& cells_;
  int dim_;
  std::vector<std::array<int, 3>> monomials_;
  std::vector<double> q_, r_;  ///< by columns; by rows
  double nearest_ = 0;         ///< node of the last patch to its first, mm
};

}  // namespace

GradientRecovery::GradientRecovery(const RecoveryCells& cells, std::vector<int> at)
    : at_(std::move(at)), axes_(cells.axes), axisymmetric_(cells.axisymmetric) {
  Neighbours neighbours(cells);
  Fit above(cells, cells.order + 1), own(cells, cells.order);
  int mark = 0;
  for (const int node : at_) {
    if (axisymmetric_) radius_.push_back(cells.points[node][0]);
    std::vector<int> patch{node};
    std::vector<std::array<double, 3>> weights;
    bool found = false;
    for (int ring = 0; ring < most_rings && !found; ++ring) {
      neighbours.grow(patch, mark++);
      found = above.find(patch, weights) && above.is_determined(weights);
    }
    if (!found) {
      ++fallbacks_;
      patch = {node};
      for (int ring = 0; ring < 2; ++ring) neighbours.grow(patch, mark++);
      found = above.find(patch, weights, true) && above.is_determined(weights);
    }
    if (!found) {
      patch = {node};
      for (int ring = 0; ring < most_rings && !found; ++ring) {
        neighbours.grow(patch, mark++);
        found = own.find(patch, weights);
      }
      assert(found && "the nodes of a single cell determine the element's polynomial");
    }
    patch_.insert(patch_.end(), patch.begin(), patch.end());
    weights_.insert(weights_.end(), weights.begin(), weights.end());
    offsets_.push_back(patch_.size());
  }
}

void GradientRecovery::restrict_to(const PartRestriction& here) {
  far_.emplace(here, patch_);
  for (int& node : patch_) node = far_->number(here, node);
  for (int& node : at_) node = here.local(node);
}

}  // namespace fsi
