#pragma once

#include <functional>

namespace fsi {

/// The one way to solve what may fail: an attempt with what there is, the same again with something stronger, and a rescue
/// by other means. Each function that attempts something \returns whether it succeeded.
struct Attempts {
  std::function<bool()> attempt;
  /// Called between two attempts.
  std::function<void()> strengthen;
  int strengthenings = 0;  ///< at most
  /// Called where all attempts have failed; empty: the caller has a fallback of its own.
  std::function<bool()> rescue;

  bool run() const {
    for (int strengthened = 0; !attempt(); ++strengthened) {
      if (strengthened == strengthenings) return rescue && rescue();
      strengthen();
    }
    return true;
  }
};

}  // namespace fsi
