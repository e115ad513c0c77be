#pragma once

#include <vector>

#include "mesh/mesh_share.hpp"

namespace fsi {

/// Nodes of a medium that a process does not hold but needs values of, as for what is made of several rings of cells
/// around a node. They are numbered behind the nodes here. Constructor and with_far() are collective.
class FarNodes {
 public:
  FarNodes() = default;
  /// \param wanted  nodes of the whole part that this process needs; those that it holds, and those named twice, may be
  ///                among them
  FarNodes(const PartRestriction& here, const std::vector<int>& wanted);

  /// The number here of a node of the whole part that is wanted or here.
  int number(const PartRestriction& here, int whole_node) const;

  /// A nodal array with the values at the far nodes behind those at the nodes here.
  template <class Layout>
  std::vector<double> with_far(const std::vector<double>& field) const {
    std::vector<double> all = field;
    all.resize(field.size() + far_.size() * static_cast<std::size_t>(Layout::entries));
    exchange_.update(all, Layout::entries);
    return all;
  }

 private:
  int nodes_ = 0;         ///< here
  std::vector<int> far_;  ///< in numbers of the whole part, ascending
  Exchange exchange_;
};

}  // namespace fsi
