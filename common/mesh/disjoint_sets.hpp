#pragma once

#include <cassert>
#include <numeric>
#include <vector>

namespace fsi {

/// Union-find over 0 .. count-1 with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    assert(i >= 0 && static_cast<std::size_t>(i) < parent_.size());
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace fsi
