#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/names.hpp"

namespace fsi {

/// Maps the names of a choice to what they stand for: factories, kinds or switches. Rows keep their order.
template <class Value>
class NameTable {
 public:
  using Row = std::pair<std::string, Value>;

  /// \param what  the choice in messages: "smoother", "partitioned.scheme"
  NameTable(std::string what, std::vector<Row> rows) : what_(std::move(what)), rows_(std::move(rows)) {}

  /// Null when there is no such name.
  const Value* find(const std::string& name) const {
    for (const auto& row : rows_)
      if (row.first == name) return &row.second;
    return nullptr;
  }
  /// \throws InputError for a name that is not in the table, with the nearest that is
  const Value& at(const std::string& name) const {
    const Value* value = find(name);
    if (value == nullptr) refuse_name(what_, name, names());
    return *value;
  }
  /// The first name that stands for `value`; empty when none does.
  std::string name_of(const Value& value) const {
    for (const auto& row : rows_)
      if (row.second == value) return row.first;
    return {};
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& row : rows_) names.push_back(row.first);
    return names;
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::string what_;
  std::vector<Row> rows_;
};

/// Whether rows, which have a member `name`, stand for these names in this order. `static_assert(names_match(...))`
/// beside the rows keeps them together with a list of names that another file owns.
template <std::size_t count, class Rows>
constexpr bool names_match(const std::array<std::string_view, count>& names, const Rows& rows) {
  if (rows.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (names[i] != rows[i].name) return false;
  return true;
}

}  // namespace fsi
