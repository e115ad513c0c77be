#include "time/restart_archive.hpp"

#include <algorithm>

namespace fsi {

bool RestartArchive::wants(std::initializer_list<std::string> names) const {
  return !recalls() || std::any_of(names.begin(), names.end(), [this](const std::string& name) { return has(name); });
}

void RestartArchive::number_if_there(const std::string& name, double& value, const Range& range) {
  if (wants({name})) number(name, value, range);
}

void RestartArchive::count_if_there(const std::string& name, int& value) {
  double count = value;
  number_if_there(name, count, count_range);
  value = static_cast<int>(count);
}

WrittenArchive& WrittenArchive::turn(bool step_changed) {
  recalls_ = true;
  step_changed_ = step_changed;
  return *this;
}

bool WrittenArchive::has(const std::string& name) const {
  return arrays.count(name) + numbers.count(name) + integers.count(name) > 0;
}

void WrittenArchive::array(const std::string& name, ArrayKind kind, std::vector<double>& values, const ArrayRule&) {
  if (recalls_) {
    values = arrays.at(name);
    return;
  }
  arrays[name] = values;
  kinds[name] = kind;
}

void WrittenArchive::number(const std::string& name, double& value, const Range&) {
  if (recalls_)
    value = numbers.at(name);
  else
    numbers[name] = value;
}

void WrittenArchive::integer(const std::string& name, std::int64_t& value, const Range&) {
  if (recalls_)
    value = integers.at(name);
  else
    integers[name] = value;
}

}  // namespace fsi
