#pragma once

#include <string>

namespace fsi::test {

/// What an error of this kind says that an action ends with; "nothing was thrown" if it does not end with one.
template <class Error, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace fsi::test
