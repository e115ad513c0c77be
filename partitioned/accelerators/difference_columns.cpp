#include "partitioned/accelerators/difference_columns.hpp"

#include <algorithm>
#include <utility>

namespace fsi {

void DifferenceColumns::start() {
  for (Column& column : columns_) ++column.age;
  while (!columns_.empty() && columns_.back().age > reused_steps_) columns_.pop_back();
}

void DifferenceColumns::abandon() {
  columns_.erase(std::remove_if(columns_.begin(), columns_.end(), [](const Column& column) { return column.age == 0; }),
                 columns_.end());
}

void DifferenceColumns::add(std::vector<double> v, std::vector<double> w) {
  columns_.insert(columns_.begin(), Column{std::move(v), std::move(w), 0});
  if (columns_.size() > most_) columns_.pop_back();
}

FilteredQr DifferenceColumns::factorise() {
  std::vector<const std::vector<double>*> v;
  for (const Column& column : columns_) v.push_back(&column.v);
  FilteredQr qr(v, filter_, space_);
  std::vector<Column> kept;
  for (const std::size_t j : qr.kept()) kept.push_back(std::move(columns_[j]));
  columns_ = std::move(kept);
  return qr;
}

void DifferenceColumns::remember(Memory& memory, const std::string& name) const {
  std::vector<double>&v = memory.arrays[name + ".v"], &w = memory.arrays[name + ".w"],
  &age = memory.arrays[name + ".age"];
  for (const Column& column : columns_) {
    v.insert(v.end(), column.v.begin(), column.v.end());
    w.insert(w.end(), column.w.begin(), column.w.end());
    age.push_back(column.age);
  }
}

void DifferenceColumns::recall(const Memory& memory, const std::string& name) {
  columns_.clear();
  const auto age = memory.arrays.find(name + ".age");
  if (age == memory.arrays.end() || age->second.empty()) return;
  const auto &v = memory.arrays.at(name + ".v"), &w = memory.arrays.at(name + ".w");
  const auto size = static_cast<std::ptrdiff_t>(v.size() / age->second.size());
  for (std::size_t j = 0; j < age->second.size(); ++j) {
    const auto from = static_cast<std::ptrdiff_t>(j) * size;
    columns_.push_back({{v.begin() + from, v.begin() + from + size},
                        {w.begin() + from, w.begin() + from + size},
                        static_cast<int>(age->second[j])});
  }
}

}  // namespace fsi
