#pragma once

#include <functional>
#include <utility>

#include "base/profile.hpp"
#include "linear/interface/linear_solver.hpp"
#include "linear/policy/attempts.hpp"

namespace fsi {

/// A linear solve by an iteration that may fail: Attempts that add up iterations and count in the run's profile what was
/// repeated and rescued.
struct LinearAttempts {
  std::function<LinearReport()> iterate;
  std::function<void()> strengthen;  ///< sets up a stronger preconditioner
  int strengthenings = 0;
  std::function<LinearReport()> factorise;  ///< empty: the caller has a fallback of its own
  Profile* profile = nullptr;               ///< null: nothing is counted

  /// \returns what the last attempt reports, with the iterations of all
  LinearReport run() const {
    LinearReport report;
    const auto count = [this](const char* event) {
      if (profile) profile->count(event);
    };
    const auto take = [&report](LinearReport latest) {
      latest.iterations += report.iterations;
      report = std::move(latest);
      return report.converged;
    };
    Attempts attempts;
    attempts.attempt = [&] { return take(iterate()); };
    attempts.strengthen = [&] {
      count("linear solves repeated with a stronger preconditioner");
      strengthen();
    };
    attempts.strengthenings = strengthenings;
    if (factorise)
      attempts.rescue = [&] {
        count("linear solves rescued by factorisation");
        return take(factorise());
      };
    attempts.run();
    return report;
  }
};

}  // namespace fsi
