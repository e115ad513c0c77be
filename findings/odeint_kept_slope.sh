#!/usr/bin/env bash
# One runge_kutta_dopri5 of Boost.Odeint that advances two states in turn, such as the pressures of two vessels, or particles
# in a flow, gives wrong results for both, one of them by a factor of five, and says nothing. It keeps the slope at the end of
# its last step, and takes that for the slope at the start of the next one, whatever state do_step is given. runge_kutta4 and
# the two other methods below keep nothing, so a program that is right with one of them goes wrong when dopri5 is put in its
# place. A stepper for each state is right, and so is reset() before each step.
# A guess would be that do_step(system, x, t, dt) depends on its arguments alone, or that the stepper notices another state.
# Seen with Boost 1.74 (Debian 12): x' = -x from 1 and from 10, ten steps of 0.1; x(1) is 0.36788 times the start.
# Output seen, x(1) by the start: runge_kutta4, cash_karp54, fehlberg78 0.36788 both; dopri5 0.07277 and 0.40087; a stepper
# each, and reset(), 0.36788 both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" libboost1.74-dev=1.74.0+ds1-21 g++=4:12.2.0-3
cat >"$scratch/12/root/two.cpp" <<'END'
#include <boost/numeric/odeint.hpp>
#include <cstdio>
#include <vector>

using State = std::vector<double>;
namespace odeint = boost::numeric::odeint;

static void decay(const State &x, State &slope, double) { slope[0] = -x[0]; }

// Ten steps of two states; `before` is called before each step.
template <class Stepper, class Before>
static void advance(const char *name, Stepper &one, Stepper &other, Before before) {
  State first{1}, second{10};
  for (int step = 0; step < 10; ++step) {
    before();
    one.do_step(decay, first, 0.1 * step, 0.1);
    before();
    other.do_step(decay, second, 0.1 * step, 0.1);
  }
  std::printf("%s: %.5f, %.5f\n", name, first[0], second[0] / 10);
}

template <class Stepper> static void together(const char *name) {
  Stepper stepper;
  advance(name, stepper, stepper, [] {});
}

int main() {
  together<odeint::runge_kutta4<State>>("runge_kutta4");
  together<odeint::runge_kutta_cash_karp54<State>>("runge_kutta_cash_karp54");
  together<odeint::runge_kutta_fehlberg78<State>>("runge_kutta_fehlberg78");
  together<odeint::runge_kutta_dopri5<State>>("runge_kutta_dopri5");
  odeint::runge_kutta_dopri5<State> one, other;
  advance("runge_kutta_dopri5, a stepper each", one, other, [] {});
  advance("runge_kutta_dopri5, reset", one, one, [&one] { one.reset(); });
}
END
within "$scratch/12" sh -c 'cd /root && g++ -std=c++17 -O0 -o two two.cpp && ./two' >"$scratch/said" 2>"$scratch/log" ||
  fail "ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the states"
runge_kutta4: 0.36788, 0.36788
runge_kutta_cash_karp54: 0.36788, 0.36788
runge_kutta_fehlberg78: 0.36788, 0.36788
runge_kutta_dopri5: 0.07277, 0.40087
runge_kutta_dopri5, a stepper each: 0.36788, 0.36788
runge_kutta_dopri5, reset: 0.36788, 0.36788
END
