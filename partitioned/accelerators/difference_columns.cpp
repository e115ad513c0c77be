#include "partitioned/accelerators/difference_columns.hpp"

#include <algorithm>
#include <utility>

namespace fsi {

void DifferenceColumns::start() {
  qr_.reset();
  for (Column& column : columns_) ++column.age;
  while (!columns_.empty() && columns_.back().age > reused_steps_) columns_.pop_back();
}

void DifferenceColumns::clear() {
  columns_.clear();
  qr_.reset();
}

void DifferenceColumns::abandon() {
  qr_.reset();
  columns_.erase(std::remove_if(columns_.begin(), columns_.end(), [](const Column& column) { return column.age == 0; }),
                 columns_.end());
}

void DifferenceColumns::add(std::vector<double> v, std::vector<double> w) {
  columns_.insert(columns_.begin(), Column{std::move(v), std::move(w), 0});
  ++new_;
  if (columns_.size() <= most_) return;
  columns_.pop_back();
  if (qr_ && qr_->kept().size() + new_ > columns_.size()) qr_->remove_last();
}

const FilteredQr& DifferenceColumns::factorise() {
  const bool goes_on = qr_ && (new_ == 0 || (new_ == 1 && qr_->insert_first(columns_.front().v)));
  if (!goes_on) {
    std::vector<const std::vector<double>*> v;
    for (const Column& column : columns_) v.push_back(&column.v);
    qr_.emplace(v, filter_, space_);
  }
  if (!goes_on || new_ > 0) {
    std::vector<Column> kept;
    for (const std::size_t j : qr_->kept()) kept.push_back(std::move(columns_[j]));
    columns_ = std::move(kept);
  }
  new_ = 0;
  return *qr_;
}

void DifferenceColumns::keep(RestartArchive& archive, const std::string& name) {
  if (archive.recalls()) clear();
  if (!archive.wants({name + ".age", name + ".v", name + ".w"})) return;
  std::vector<double> v, w, age;
  for (const Column& column : columns_) {
    v.insert(v.end(), column.v.begin(), column.v.end());
    w.insert(w.end(), column.w.begin(), column.w.end());
    age.push_back(column.age);
  }
  ArrayRule ages;
  ages.each = count_range;
  archive.array(name + ".age", ArrayKind::alike, age, ages);
  archive.array(name + ".v", ArrayKind::interface_columns, v, {{}, age.size()});
  archive.array(name + ".w", ArrayKind::interface_columns, w, {{}, age.size()});
  if (!archive.recalls()) return;
  const auto size = static_cast<std::ptrdiff_t>(age.empty() ? 0 : v.size() / age.size());
  for (std::size_t j = 0; j < age.size(); ++j) {
    const auto from = static_cast<std::ptrdiff_t>(j) * size;
    columns_.push_back({{v.begin() + from, v.begin() + from + size},
                        {w.begin() + from, w.begin() + from + size},
                        static_cast<int>(age[j])});
  }
}

}  // namespace fsi
