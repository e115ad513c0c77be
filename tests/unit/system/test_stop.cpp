#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "fem/p1_tetrahedron.hpp"
#include "host/stop_request.hpp"
#include "host/threads.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test {

namespace {

/// Exit code of a forked process that does this: a request to end is never taken back.
template <class Body>
int code_of(Body body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

enum Code { gave_up = 10, levels_changed, went_on };

TEST(Stop, EndsAStepBetweenTwoIterationsAndLeavesTheFinishedLevels) {
  EXPECT_EQ(code_of([] {
              set_threads(1);
              const auto setup = coupled_case("neo-hookean");
              const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
              const Loads loads(setup);
              NewtonOptions options;
              options.observe_iteration = [](const NewtonReport& so_far) {
                if (so_far.count() == 2) request_stop(SIGTERM);
              };
              NewtonStepper<3> stepper(*scene, loads, options, number_scene(*scene));
              State state = scene->at_rest();
              const State before = state;
              try {
                stepper.advance(state);
              } catch (const Stopped&) {
                const bool same = state.step == 0 && state.before[0].wall == before.before[0].wall &&
                                  state.before[0].fluid == before.before[0].fluid;
                return static_cast<int>(same ? gave_up : levels_changed);
              }
              return static_cast<int>(went_on);
            }),
            gave_up);
}

TEST(Stop, TheFirstSignalCounts) {
  EXPECT_EQ(code_of([] {
              if (look_for_stop() != 0) return 1;
              request_stop(SIGTERM);
              request_stop(SIGINT);
              return look_for_stop() == requested_stop() ? look_for_stop() : 1;
            }),
            SIGTERM);
}

TEST(Stop, KnowsTheLongestTimeBetweenTwoLooks) {
  EXPECT_EQ(code_of([] {
              look_for_stop();
              usleep(20'000);
              look_for_stop();
              look_for_stop();
              const double longest = longest_time_between_looks();
              return longest >= 0.02 && longest_time_between_looks() == 0 ? 0 : 1;
            }),
            0);
}

}  // namespace

}  // namespace fsi::test
