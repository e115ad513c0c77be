#include "monolithic/coupled_solvers/amg/braess_sarazin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "monolithic/coupled_solvers/amg/gauss_seidel.hpp"
#include "monolithic/coupled_solvers/amg/small_inverse.hpp"

namespace fsi {

namespace {

/// Pattern of D Ahat^-1 G: nodes that share a neighbour.
NodeGraph squared(const NodeGraph& graph) {
  NodeGraph square;
  square.offsets.assign(1, 0);
  std::vector<int> seen(graph.rows(), -1), columns;
  for (int row = 0; row < graph.rows(); ++row) {
    columns.clear();
    for (int a = graph.offsets[row]; a < graph.offsets[row + 1]; ++a) {
      const int middle = graph.columns[a];
      for (int b = graph.offsets[middle]; b < graph.offsets[middle + 1]; ++b) {
        const int column = graph.columns[b];
        if (seen[column] == row) continue;
        seen[column] = row;
        columns.push_back(column);
      }
    }
    std::sort(columns.begin(), columns.end());
    square.columns.insert(square.columns.end(), columns.begin(), columns.end());
    square.offsets.push_back(static_cast<int>(square.columns.size()));
  }
  return square;
}

constexpr int threaded_blocks = 100000;  // fewer blocks are not worth waking threads for

}  // namespace

template <int Size>
BraessSarazin<Size>::BraessSarazin(const Matrix& a, const BraessSarazinOptions& options)
    : options_(options),
      graph_(*a.graph),
      colours_(colour_rows(graph_)),
      diagonal_(graph_.rows()),
      momentum_(static_cast<std::size_t>(graph_.blocks()) * Size * Size),
      continuity_(static_cast<std::size_t>(graph_.blocks()) * Size),
      gradient_(static_cast<std::size_t>(graph_.blocks()) * n),
      block_inverse_(static_cast<std::size_t>(graph_.rows()) * n * n),
      hat_inverse_(block_inverse_.size()),
      schur_graph_(std::make_shared<NodeGraph>(squared(graph_))),
      schur_end_(graph_.rows()),
      direct_(graph_.rows() <= options.schur_direct_nodes),
      schur_(direct_ ? 0 : schur_graph_->blocks()),
      schur_inverse_diagonal_(graph_.rows()),
      q_(graph_.rows()),
      schur_right_(graph_.rows()),
      predicted_(options.momentum_sweeps > 0 ? 0 : static_cast<std::size_t>(graph_.rows()) * n) {
  for (int i = 0; i < graph_.rows(); ++i) diagonal_[i] = graph_.find(i, i);
  if (direct_) {
    schur_matrix_ = BlockMatrix<1, 1>(schur_graph_);
  } else {
    schur_colours_ = colour_rows(*schur_graph_);
    schur_columns_.resize(schur_graph_->blocks());
  }
}

template <int Size>
void BraessSarazin<Size>::update(const Matrix& a) {
  const int rows = graph_.rows();
#pragma omp parallel for schedule(static) if (graph_.blocks() > threaded_blocks)
  for (int i = 0; i < rows; ++i) {
    double sum[n] = {};
    for (int at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
      const double* block = a.block(at);
      for (int r = 0; r < n; ++r) {
        for (int c = 0; c < Size; ++c)
          momentum_[(static_cast<std::size_t>(at) * Size + c) * Size + r] = static_cast<Real>(block[r * Size + c]);
        gradient_[static_cast<std::size_t>(at) * n + r] = static_cast<Real>(block[r * Size + n]);
        sum[r] += block[r * Size + r];
      }
      for (int c = 0; c < Size; ++c)
        continuity_[static_cast<std::size_t>(at) * Size + c] = static_cast<Real>(block[n * Size + c]);
    }
    const double* block = a.block(diagonal_[i]);
    double inverse[n * n];
    int pivots[n];
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) inverse[r * n + c] = block[r * Size + c];
    invert_in_place(inverse, n, pivots);
    double own = 0, total = 0;
    for (int r = 0; r < n; ++r) {
      own += block[r * Size + r];
      total += sum[r];
    }
    const double ratio = options_.scaling * (options_.row_sums ? std::max(1.0, total / own) : 1.0);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const std::size_t to = static_cast<std::size_t>(i) * n * n + r * n + c;
        block_inverse_[to] = static_cast<Real>(inverse[r * n + c]);
        if (options_.diagonal == MomentumDiagonal::block)
          hat_inverse_[to] = static_cast<Real>(inverse[r * n + c] / ratio);
        else
          hat_inverse_[to] = static_cast<Real>(r == c ? 1 / (block[r * Size + r] * ratio) : 0.0);
      }
  }
  update_schur();
}

/// S = E - D Ahat^-1 G, row by row.
template <int Size>
void BraessSarazin<Size>::update_schur() {
  const int rows = graph_.rows();
  const NodeGraph& pattern = *schur_graph_;
#pragma omp parallel if (graph_.blocks() > threaded_blocks)
  {
    thread_local std::vector<double> sum;
    sum.resize(std::max<std::size_t>(sum.size(), rows));
#pragma omp for schedule(static)
    for (int i = 0; i < rows; ++i) {
      for (int at = pattern.offsets[i]; at < pattern.offsets[i + 1]; ++at) sum[pattern.columns[at]] = 0;
      for (int at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
        const int j = graph_.columns[at];
        const Real* row = &continuity_[static_cast<std::size_t>(at) * Size];
        const Real* hat = &hat_inverse_[static_cast<std::size_t>(j) * n * n];
        sum[j] += row[n];
        Real left[n] = {};
        for (int r = 0; r < n; ++r)
          for (int c = 0; c < n; ++c) left[c] += row[r] * hat[r * n + c];
        for (int b = graph_.offsets[j]; b < graph_.offsets[j + 1]; ++b) {
          const Real* g = &gradient_[static_cast<std::size_t>(b) * n];
          Real product = 0;
          for (int c = 0; c < n; ++c) product += left[c] * g[c];
          sum[graph_.columns[b]] -= product;
        }
      }
      if (direct_) {
        for (int at = pattern.offsets[i]; at < pattern.offsets[i + 1]; ++at)
          schur_matrix_.values[at] = sum[pattern.columns[at]];
        continue;
      }
      const double limit = options_.schur_drop * std::abs(sum[i]);
      int to = pattern.offsets[i], diagonal = to;
      for (int at = pattern.offsets[i]; at < pattern.offsets[i + 1]; ++at) {
        const int j = pattern.columns[at];
        if (j == i) {
          diagonal = to;
        } else if (std::abs(sum[j]) < limit) {
          sum[i] += sum[j];
          continue;
        }
        schur_columns_[to] = j;
        schur_[to++] = static_cast<Real>(sum[j]);
      }
      schur_[diagonal] = static_cast<Real>(sum[i]);
      schur_end_[i] = to;
      schur_inverse_diagonal_[i] = static_cast<Real>(sum[i] != 0 ? 1 / sum[i] : 0.0);
    }
  }
  if (direct_) schur_solver_.update(schur_matrix_);
}

template <int Size>
void BraessSarazin<Size>::predict(const std::vector<double>& b, std::vector<double>& x, bool backward) {
  const auto momentum_residual = [&](int i, double* sum) {
    for (int r = 0; r < Size; ++r) sum[r] = b[static_cast<std::size_t>(i) * Size + r];
    for (int at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
      const Real* block = &momentum_[static_cast<std::size_t>(at) * Size * Size];
      const double* from = x.data() + static_cast<std::size_t>(graph_.columns[at]) * Size;
      for (int c = 0; c < Size; ++c)
        for (int r = 0; r < Size; ++r) sum[r] -= block[c * Size + r] * from[c];
    }
  };
  const auto correct = [&](int i, const double* sum, const std::vector<Real>& inverse, double* to) {
    const Real* block = &inverse[static_cast<std::size_t>(i) * n * n];
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) to[r] += block[r * n + c] * sum[c];
  };
  const bool threaded = graph_.blocks() > threaded_blocks;
  if (options_.momentum_sweeps > 0) {
    for (int sweep = 0; sweep < options_.momentum_sweeps; ++sweep)
      sweep_colours(colours_, backward != (sweep % 2 == 1), threaded, [&](int i) {
        double sum[Size];
        momentum_residual(i, sum);
        correct(i, sum, block_inverse_, x.data() + static_cast<std::size_t>(i) * Size);
      });
    return;
  }
#pragma omp parallel for schedule(static) if (threaded)
  for (int i = 0; i < graph_.rows(); ++i) {
    double sum[Size];
    momentum_residual(i, sum);
    double* to = &predicted_[static_cast<std::size_t>(i) * n];
    for (int r = 0; r < n; ++r) to[r] = 0;
    correct(i, sum, hat_inverse_, to);
  }
#pragma omp parallel for schedule(static) if (threaded)
  for (int i = 0; i < graph_.rows(); ++i)
    for (int r = 0; r < n; ++r)
      x[static_cast<std::size_t>(i) * Size + r] += predicted_[static_cast<std::size_t>(i) * n + r];
}

template <int Size>
void BraessSarazin<Size>::solve_schur(bool backward) {
  if (direct_) {
    schur_solver_.solve(schur_right_, q_);
    return;
  }
  std::fill(q_.begin(), q_.end(), 0.0);
  const auto row = [&](int i) {
    double sum = schur_right_[i];
    for (int at = schur_graph_->offsets[i]; at < schur_end_[i]; ++at) sum -= schur_[at] * q_[schur_columns_[at]];
    q_[i] += options_.schur_relaxation * sum * schur_inverse_diagonal_[i];
  };
  const bool threaded = schur_graph_->blocks() > 4 * threaded_blocks;
  for (int sweep = 0; sweep < 2 * options_.schur_sweeps; ++sweep)
    sweep_colours(schur_colours_, backward != (sweep % 2 == 1), threaded, row);
}

template <int Size>
void BraessSarazin<Size>::smooth(const Matrix&, const std::vector<double>& b, std::vector<double>& x, int steps,
                                 bool backward, bool) {
  const int rows = graph_.rows();
  const bool threaded = graph_.blocks() > threaded_blocks;
  for (int step = 0; step < steps; ++step) {
    predict(b, x, backward);
#pragma omp parallel for schedule(static) if (threaded)
    for (int i = 0; i < rows; ++i) {
      double sum = b[static_cast<std::size_t>(i) * Size + n];
      for (int at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
        const Real* row = &continuity_[static_cast<std::size_t>(at) * Size];
        const double* from = x.data() + static_cast<std::size_t>(graph_.columns[at]) * Size;
        for (int c = 0; c < Size; ++c) sum -= row[c] * from[c];
      }
      schur_right_[i] = sum;
    }
    solve_schur(backward);
#pragma omp parallel for schedule(static) if (threaded)
    for (int i = 0; i < rows; ++i) {
      double sum[n] = {};
      for (int at = graph_.offsets[i]; at < graph_.offsets[i + 1]; ++at) {
        const Real* g = &gradient_[static_cast<std::size_t>(at) * n];
        for (int r = 0; r < n; ++r) sum[r] += g[r] * q_[graph_.columns[at]];
      }
      double* to = x.data() + static_cast<std::size_t>(i) * Size;
      const Real* hat = &hat_inverse_[static_cast<std::size_t>(i) * n * n];
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) to[r] -= options_.damping * hat[r * n + c] * sum[c];
      to[n] += options_.damping * q_[i];
    }
  }
}

template <int Size>
std::size_t BraessSarazin<Size>::bytes() const {
  return (momentum_.size() + continuity_.size() + gradient_.size() + block_inverse_.size() + hat_inverse_.size() +
          schur_.size() + schur_inverse_diagonal_.size()) *
             sizeof(Real) +
         (schur_graph_->columns.size() + schur_columns_.size() + schur_graph_->offsets.size() + colours_.rows.size() +
          schur_colours_.rows.size() + diagonal_.size()) *
             sizeof(int) +
         (direct_ ? schur_solver_.bytes() : 0) +
         (schur_matrix_.values.size() + q_.size() + schur_right_.size() + predicted_.size()) * sizeof(double);
}

template class BraessSarazin<3>;
template class BraessSarazin<4>;

}  // namespace fsi
