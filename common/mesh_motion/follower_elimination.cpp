#include "mesh_motion/follower_elimination.hpp"

#include <algorithm>

#include "host/parallel_for.hpp"

namespace fsi {

namespace {

/// Per row, whether it is a follower: none couples with another.
std::vector<char> find_followers(const CsrMatrix<double>& a) {
  std::vector<char> follows(a.rows(), 0);
  for (int row = 0; row < a.rows(); ++row) {
    bool beside_follower = false;
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      if (a.indices[at] != row && a.values[at] != 0) beside_follower = beside_follower || follows[a.indices[at]] != 0;
    follows[row] = FollowerElimination::leaders(a, row) <= FollowerElimination::most_leaders && !beside_follower;
  }
  return follows;
}

}  // namespace

int FollowerElimination::leaders(const CsrMatrix<double>& a, int row) {
  int count = 0;
  for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) count += a.indices[at] != row && a.values[at] != 0;
  return count;
}

FollowerElimination::FollowerElimination(const CsrMatrix<double>& a, CsrMatrix<double>& reduced)
    : FollowerElimination(a, find_followers(a), a.rows(), reduced) {}

FollowerElimination::FollowerElimination(const CsrMatrix<double>& a, const std::vector<char>& follows, int own,
                                         CsrMatrix<double>& reduced) {
  std::vector<int> number(a.rows());  // among the kept ones, or among the followers
  for (int row = 0; row < a.rows(); ++row) {
    auto& among = follows[row] ? followers_ : kept_;
    number[row] = static_cast<int>(among.size());
    among.push_back(row);
    if (row < own) ++(follows[row] ? own_followers_ : own_kept_);
  }
  const int kept = static_cast<int>(kept_.size());
  shares_.columns = kept;
  for (const int row : followers_) {
    double diagonal = 0;
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at)
      if (a.indices[at] == row) diagonal = a.values[at];
    inverse_diagonal_.push_back(1 / diagonal);
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) {
      if (a.indices[at] == row || a.values[at] == 0 || follows[a.indices[at]]) continue;
      shares_.indices.push_back(number[a.indices[at]]);
      shares_.values.push_back(a.values[at] / diagonal);
    }
    shares_.offsets.push_back(static_cast<int>(shares_.indices.size()));
  }
  transposed_shares_ = transposed(shares_);

  reduced = CsrMatrix<double>();
  reduced.columns = kept;
  std::vector<double> sum(kept, 0.0);
  std::vector<char> seen(kept, 0);
  std::vector<int> columns;
  for (int i = 0; i < own_kept_; ++i) {
    const int row = kept_[i];
    columns.clear();
    const auto add = [&](int column, double value) {
      if (!seen[column]) columns.push_back(column);
      seen[column] = 1;
      sum[column] += value;
    };
    for (int at = a.offsets[row]; at < a.offsets[row + 1]; ++at) {
      const int column = a.indices[at];
      if (!follows[column]) {
        add(number[column], a.values[at]);
        continue;
      }
      const int follower = number[column];
      for (int to = shares_.offsets[follower]; to < shares_.offsets[follower + 1]; ++to)
        add(shares_.indices[to], -a.values[at] * shares_.values[to]);
    }
    std::sort(columns.begin(), columns.end());
    for (const int column : columns) {
      reduced.indices.push_back(column);
      reduced.values.push_back(sum[column]);
      sum[column] = 0;
      seen[column] = 0;
    }
    reduced.offsets.push_back(static_cast<int>(reduced.indices.size()));
  }
}

void FollowerElimination::reduce(const std::vector<double>& b, int count, std::vector<double>& of_kept) const {
  const std::size_t kept = own_kept_, rows = kept_.size() + followers_.size();
  of_kept.resize(kept * count);
  for (int c = 0; c < count; ++c) {
    const double* from = b.data() + rows * c;
    double* to = of_kept.data() + kept * c;
    parallel_for(kept, kept > 20000, [&](std::size_t i) {
      double sum = from[kept_[i]];
      for (int at = transposed_shares_.offsets[i]; at < transposed_shares_.offsets[i + 1]; ++at)
        sum -= transposed_shares_.values[at] * from[followers_[transposed_shares_.indices[at]]];
      to[i] = sum;
    });
  }
}

void FollowerElimination::complete(const std::vector<double>& b, const std::vector<double>& of_kept, int count,
                                   std::vector<double>& x) const {
  const std::size_t kept = kept_.size(), rows = kept + followers_.size();
  x.resize(rows * count);
  for (int c = 0; c < count; ++c) {
    const double* right = b.data() + rows * c;
    const double* from = of_kept.data() + kept * c;
    double* to = x.data() + rows * c;
    for (std::size_t i = 0; i < kept; ++i) to[kept_[i]] = from[i];
    parallel_for(own_followers_, own_followers_ > 20000, [&](std::size_t f) {
      double value = inverse_diagonal_[f] * right[followers_[f]];
      for (int at = shares_.offsets[f]; at < shares_.offsets[f + 1]; ++at)
        value -= shares_.values[at] * from[shares_.indices[at]];
      to[followers_[f]] = value;
    });
  }
}

std::size_t FollowerElimination::bytes() const {
  return (kept_.size() + followers_.size()) * sizeof(int) + inverse_diagonal_.size() * sizeof(double) +
         shares_.bytes() + transposed_shares_.bytes();
}

}  // namespace fsi
