#include "parallel/whole_order.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

namespace fsi {

namespace {

using Lists = std::vector<std::vector<std::int64_t>>;

/// Whole numbers to other processes; they are far below 2^53.
Lists sent(const Communicator& processes, const Lists& to_each) {
  std::vector<std::vector<double>> numbers;
  for (const auto& list : to_each) numbers.emplace_back(list.begin(), list.end());
  Lists received;
  for (const auto& list : processes.send_and_receive(numbers)) received.emplace_back(list.begin(), list.end());
  return received;
}

/// `entries` numbers for each place of the lists.
std::vector<std::vector<double>> picked(const Lists& lists, const double* values, int entries) {
  std::vector<std::vector<double>> numbers(lists.size());
  for (std::size_t r = 0; r < lists.size(); ++r) {
    numbers[r].reserve(lists[r].size() * static_cast<std::size_t>(entries));
    for (const std::int64_t place : lists[r])
      numbers[r].insert(numbers[r].end(), values + place * entries, values + (place + 1) * entries);
  }
  return numbers;
}

std::vector<double> placed(const Lists& lists, const std::vector<std::vector<double>>& numbers, std::size_t size,
                           int entries) {
  std::vector<double> values(size * static_cast<std::size_t>(entries));
  for (std::size_t r = 0; r < lists.size(); ++r) {
    assert(numbers[r].size() == lists[r].size() * static_cast<std::size_t>(entries));
    const double* from = numbers[r].data();
    for (const std::int64_t place : lists[r]) {
      std::copy_n(from, entries, values.begin() + static_cast<std::ptrdiff_t>(place * entries));
      from += entries;
    }
  }
  return values;
}

}  // namespace

WholeOrder::WholeOrder(const Communicator& processes, std::vector<std::int64_t> places, const std::vector<char>& owned,
                       std::int64_t whole)
    : processes_(&processes),
      items_(places.size()),
      whole_(whole),
      owned_(static_cast<std::size_t>(processes.size())),
      wanted_(owned_.size()) {
  assert(owned.size() == places.size());
  Lists places_owned(owned_.size()), places_wanted(owned_.size());
  bool fits = true;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] < 0 || places[i] >= whole) {
      fits = false;
      continue;
    }
    const auto r = static_cast<std::size_t>(holder(places[i]));
    wanted_[r].push_back(static_cast<std::int64_t>(i));
    places_wanted[r].push_back(places[i]);
    if (owned[i] == 0) continue;
    owned_[r].push_back(static_cast<std::int64_t>(i));
    places_owned[r].push_back(places[i]);
  }
  taken_ = sent(processes, places_owned);
  handed_ = sent(processes, places_wanted);
  std::vector<char> has(static_cast<std::size_t>(count()), 0);
  for (auto* lists : {&taken_, &handed_})
    for (auto& list : *lists)
      for (auto& place : list) place -= first();
  for (const auto& list : taken_)
    for (const auto place : list) {
      auto& here = has[static_cast<std::size_t>(place)];
      fits = fits && here == 0;
      here = 1;
    }
  fits = fits && std::all_of(has.begin(), has.end(), [](char one) { return one != 0; });
  if (processes.any(!fits)) throw std::logic_error("items of processes are not each owned by one of them");
}

WholeOrder::WholeOrder(const NodeShare& share)
    : WholeOrder(*share.processes, {share.whole_node.begin(), share.whole_node.end()}, share.owned, share.whole_nodes) {
}

WholeOrder WholeOrder::by_keys(const Communicator& processes, const std::vector<std::int64_t>& keys,
                               const std::vector<char>& owned) {
  std::vector<std::int64_t> own;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (owned[i] != 0) own.push_back(keys[i]);
  auto all = processes.gather(own);
  std::sort(all.begin(), all.end());
  std::vector<std::int64_t> places;
  for (const auto key : keys) {
    const auto found = std::lower_bound(all.begin(), all.end(), key);
    places.push_back(found != all.end() && *found == key ? found - all.begin() : -1);
  }
  return {processes, std::move(places), owned, static_cast<std::int64_t>(all.size())};
}

int WholeOrder::holder(std::int64_t place) const {
  auto rank = static_cast<int>(place * processes_->size() / whole_);
  while (place >= bound(rank + 1)) ++rank;
  while (place < bound(rank)) --rank;
  return rank;
}

std::vector<double> WholeOrder::to_stretches(const double* values, int entries) const {
  return placed(taken_, processes_->send_and_receive(picked(owned_, values, entries)),
                static_cast<std::size_t>(count()), entries);
}

std::vector<double> WholeOrder::from_stretches(const double* stretch, int entries) const {
  return placed(wanted_, processes_->send_and_receive(picked(handed_, stretch, entries)), items_, entries);
}

}  // namespace fsi
