#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "mesh_io/gmsh_file.hpp"

namespace fsi {

/// The way from a node's tag to its place in the file.
class NodeIndex {
 public:
  NodeIndex(const GmshFile& gmsh, const std::string& file) {
    entries_.reserve(gmsh.node_tags.size());
    for (std::size_t i = 0; i < gmsh.node_tags.size(); ++i)
      entries_.emplace_back(gmsh.node_tags[i], static_cast<int>(i));
    std::sort(entries_.begin(), entries_.end());
    for (std::size_t i = 1; i < entries_.size(); ++i)
      if (entries_[i].first == entries_[i - 1].first)
        throw InputError(file, "$Nodes", fmt::format("node tag {} appears twice", entries_[i].first),
                         "give every node a tag of its own");
  }

  /// -1 for a tag that no node has.
  int find(std::int64_t tag) const {
    // Tags mostly run from 1 without gaps; then the place is known without a search.
    if (tag >= 1 && tag <= static_cast<std::int64_t>(entries_.size()) && entries_[tag - 1].first == tag)
      return entries_[tag - 1].second;
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), std::make_pair(tag, 0));
    return found != entries_.end() && found->first == tag ? found->second : -1;
  }

 private:
  std::vector<std::pair<std::int64_t, int>> entries_;
};

}  // namespace fsi
