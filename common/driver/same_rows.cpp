#include "driver/same_rows.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace fsi {

namespace {

constexpr double same_state = 1e-6;  // relative: what programs of different compilers may make of one state

}  // namespace

void Agreement::include(double a, double b) {
  size_ = std::max({size_, std::abs(a), std::abs(b)});
  apart_ = std::max(apart_, std::abs(a - b));
}

void require_agreement(const EarlierTables& earlier, const std::string& file, double time, const Agreement& found) {
  if (found.apart() <= same_state * found.size()) return;
  throw InputError(
      (earlier.folder() / file).string(), "",
      fmt::format("its rows of the time {:g} differ from the checkpoint's state by {:.1e} of their largest "
                  "value: the two are not of one run",
                  time, found.apart() / found.size()),
      "restart from a folder as its run has left it, or run from the start");
}

}  // namespace fsi
