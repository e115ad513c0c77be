#pragma once

#include <cassert>
#include <map>
#include <vector>

#include "fem/nodal_layout.hpp"

namespace fsi {

/// Prescribed components of a vector field at the nodes of one medium, with their values: zero unless given. At nodes
/// with a frame (NodalFrames) components are the frame's, and values zero.
/// \tparam Components  of a vector
template <int Components>
class DirichletConditions {
 public:
  using Layout = VectorLayout<Components>;

  DirichletConditions() = default;
  explicit DirichletConditions(int nodes) : fixed_(Layout::size(nodes), 0) {}

  void fix(int node, int component, double value = 0) {
    assert(component >= 0 && component < Components);
    const std::size_t at = Layout::vector(node, component);
    assert(at < fixed_.size());
    fixed_[at] = 1;
    if (value != 0 || values_.count(at) > 0) values_[at] = value;
  }
  /// The whole vector, to zero.
  void fix(int node) {
    for (int k = 0; k < Components; ++k) fix(node, k);
  }

  bool fixes(int node, int component) const { return fixed_[Layout::vector(node, component)] != 0; }
  /// All components of the node.
  bool fixes(int node) const {
    for (int k = 0; k < Components; ++k)
      if (!fixes(node, k)) return false;
    return true;
  }
  int node_count() const { return static_cast<int>(fixed_.size()) / Components; }

  /// Writes the values that are not zero to the vectors of a nodal array.
  template <class ArrayLayout>
  void impose(std::vector<double>& field) const {
    for (const auto& [entry, value] : values_) {
      const int node = static_cast<int>(entry) / Components, component = static_cast<int>(entry) % Components;
      field[ArrayLayout::vector(node, component)] = value;
    }
  }

 private:
  std::vector<char> fixed_;               ///< in the vector layout
  std::map<std::size_t, double> values_;  ///< entry and value, where not zero
};

}  // namespace fsi
