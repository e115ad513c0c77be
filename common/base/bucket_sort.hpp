#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fsi {

/// Sorts by key(entry), a number from 0 to buckets - 1, and entries of one key by `less`. Takes linear time where few
/// entries share a key, as the facets at a node.
template <class Entry, class Key, class Less>
void bucket_sort(std::vector<Entry>& entries, std::size_t buckets, Key key, Less less) {
  std::vector<std::size_t> begin(buckets + 1, 0);
  for (const Entry& entry : entries) ++begin[static_cast<std::size_t>(key(entry)) + 1];
  for (std::size_t b = 0; b < buckets; ++b) begin[b + 1] += begin[b];
  std::vector<Entry> sorted(entries.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const Entry& entry : entries) sorted[next[static_cast<std::size_t>(key(entry))]++] = entry;
  for (std::size_t b = 0; b < buckets; ++b)
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin[b]),
              sorted.begin() + static_cast<std::ptrdiff_t>(begin[b + 1]), less);
  entries.swap(sorted);
}

}  // namespace fsi
