#include "wall/supports.hpp"

#include <algorithm>
#include <utility>

#include "fem/dimensions.hpp"

namespace fsi {

template <int n>
void WallSupports<n>::SurfaceMatrix::merge() {
  const auto place = [](const Entry& entry) { return std::pair(entry.row, entry.column); };
  std::stable_sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
  std::vector<Entry> merged;
  for (const Entry& entry : entries) {
    if (merged.empty() || place(merged.back()) != place(entry)) {
      merged.push_back(entry);
      continue;
    }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) merged.back().block[i][j] += entry.block[i][j];
  }
  entries = std::move(merged);
}

template <int n>
double WallSupports<n>::SurfaceMatrix::product(const double* y, const double* d) const {
  double sum = 0;
  for (const Entry& entry : entries)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        sum += y[Mixed::vector(entry.row, i)] * entry.block[i][j] * d[Mixed::vector(entry.column, j)];
  return sum;
}

template <int n>
void WallSupports<n>::add(const WallInput& in, std::vector<double>& residual, Matrix* jacobian) const {
  const auto add_force = [&](const SurfaceMatrix& matrix, double factor, const double* d, const double* reference) {
    for (const auto& entry : matrix.entries)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const std::size_t from = Mixed::vector(entry.column, j);
          const double x = d[from] - (reference ? reference[from] : 0.0);
          residual[Mixed::vector(entry.row, i)] += factor * entry.block[i][j] * x;
          if (jacobian) jacobian->block(entry.position)[i * Mixed::entries + j] += factor * entry.block[i][j];
        }
  };
  add_force(springs_, 1, in.wall, nullptr);
  if (in.velocity_rate != 0) add_force(dampers_, in.velocity_rate, in.wall, in.velocity_reference);
  if (in.support_loads)
    for (std::size_t i = 0; i < loads_.size(); ++i)
      if (in.support_loads[i] != 0) loads_[i](in.support_loads[i], in.wall, residual, jacobian);
}

template <int n>
double WallSupports<n>::stored(const std::vector<double>& wall) const {
  return 0.5 * springs_.product(wall.data(), wall.data());
}

template <int n>
std::vector<double> WallSupports<n>::difference(const double* a, const double* b, double factor, std::size_t size) {
  std::vector<double> c(size);
  for (std::size_t i = 0; i < size; ++i) c[i] = factor * (a[i] - b[i]);
  return c;
}

template <int n>
SupportWork WallSupports<n>::work(const WallStep& step) const {
  const std::size_t size = Mixed::size(graph_.rows());
  const double* d = step.balance.wall;
  // What the balance's velocity moves in its duration; in statics the way of the step.
  const auto moved = difference(d, step.reference, step.duration * step.rate, size);
  SupportWork work;
  work.damping =
      step.balance.velocity_rate * dampers_.product(moved.data(), difference(d, step.reference, 1, size).data());
  if (!springs_.entries.empty())  // differences first, free of cancellation: omega (d_1 . K d_1 - d_0 . K d_0) / 2
    work.springs = springs_.product(moved.data(), d) -
                   0.5 * step.weight *
                       (springs_.product(difference(step.end, step.start, 1, size).data(), step.end) +
                        springs_.product(difference(step.end, step.start, 1, size).data(), step.start));
  if (!loads_.empty() && step.balance.support_loads) {
    std::vector<double> force(size, 0.0);
    for (std::size_t i = 0; i < loads_.size(); ++i)
      if (step.balance.support_loads[i] != 0) loads_[i](step.balance.support_loads[i], d, force, nullptr);
    for (std::size_t i = 0; i < size; ++i)
      if (!share_ || share_->owned[i / Mixed::entries] != 0) work.loads -= force[i] * moved[i];
  }
  return work;
}

#define FSI_INSTANTIATE(n) template class WallSupports<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
