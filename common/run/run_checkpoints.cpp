#include "run/run_checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "base/finite.hpp"
#include "case/case_hash.hpp"
#include "fem/dimensions.hpp"
#include "restart/state_checkpoint.hpp"
#include "run/result_place.hpp"
#include "time/time_schemes.hpp"

namespace fsi {

namespace {

// What stands before the names of what is kept, by the owner.
constexpr const char* of_stepper = "stepper.";
constexpr const char* of_march = "march.";
constexpr const char* of_tables = "table.";

constexpr const char* scheme_name = "time_scheme";  // the run's, as the number of its TimeScheme

/// What may have kept numbers that this run does not go on with: another method, another observer.
std::vector<std::string> others() {
  auto words = words_of_observers();
  words.insert(words.end(), {of_stepper, of_march, of_tables});
  return words;
}

}  // namespace

template <int n>
RunCheckpoints<n>::RunCheckpoints(RunParts<n>& parts, const Observers& observers)
    : parts_(parts),
      observers_(observers),
      pace_({parts.setup.output.checkpoint_every, parts.setup.output.checkpoint_seconds}) {}

template <int n>
void RunCheckpoints<n>::keep_method(RestartArchive& archive) {
  PrefixedArchive marching(of_march, archive), stepping(of_stepper, archive);
  parts_.march.keep(marching);
  parts_.stepper->keep(stepping);
}

/// A scheme that was chosen for the steps of the run so far stays, since the state is its own.
template <int n>
void RunCheckpoints<n>::keep_scheme(RestartArchive& archive) {
  if (parts_.scene.is_static()) return;
  std::int64_t number = time_schemes().at(parts_.scheme).number;
  if (archive.wants({scheme_name})) archive.integer(scheme_name, number);
  if (parts_.setup.time->scheme || number == time_schemes().at(parts_.scheme).number) return;
  std::string kept = parts_.scheme;
  for (const auto* chosen : {scheme_for_short_steps, scheme_for_long_steps})
    if (number == time_schemes().at(chosen).number) kept = chosen;
  parts_.keep_scheme(kept);
}

template <int n>
Checkpoint RunCheckpoints<n>::of_now() {
  WrittenArchive archive;
  PrefixedArchive of_digests(of_tables, archive);
  keep_scheme(archive);
  keep(parts_.state, archive);
  write_down_steps(parts_.loads.axis(), parts_.state, archive);
  keep(digests_, of_digests);
  observers_.keep(archive);
  keep_method(archive);
  Checkpoint checkpoint;
  checkpoint.program = parts_.program;
  checkpoint.case_hash = parts_.case_hash;
  checkpoint.case_text = parts_.case_text;
  checkpoint.mesh_hash = parts_.loaded.mesh.hash;
  checkpoint.step = parts_.state.step;
  checkpoint.time = parts_.state.time;
  checkpoint.arrays = std::move(archive.arrays);
  checkpoint.kinds = std::move(archive.kinds);
  checkpoint.integers = std::move(archive.integers);
  checkpoint.reals = std::move(archive.numbers);
  return checkpoint;
}

template <int n>
void RunCheckpoints<n>::vouch(ResultFolder& folder) {
  folder.take_digests();
  digests_ = folder.digests();
}

template <int n>
void RunCheckpoints<n>::keep_finished() {
  finished_.reset();
  if (parts_.state.step > 0 && saved_ != parts_.state.step) finished_ = of_now();
}

template <int n>
bool RunCheckpoints<n>::is_due(bool finished) const {
  if (!pace_.writes_any()) return false;
  if (finished) return true;
  return parts_.processes.any(parts_.first.is_here() && pace_.is_due(parts_.state.step, seconds_since(parts_.start)));
}

template <int n>
void RunCheckpoints<n>::save() {
  const auto phase = parts_.scene.profile.phase("checkpoint");
  const auto start = Clock::now();
  write(of_now());
  saved_ = parts_.state.step;
  pace_.written(seconds_since(parts_.start), seconds_since(start));
}

template <int n>
void RunCheckpoints<n>::save_finished() {
  if (finished_) write(*finished_);
}

template <int n>
void RunCheckpoints<n>::write(const Checkpoint& checkpoint) const {
  do_together(parts_.processes, [&] {
    for (const auto& [name, numbers] : checkpoint.arrays) require_finite(numbers, "the checkpoint's " + name);
  });
  write_checkpoint(checkpoint_file(parts_.line.output), checkpoint, parts_.processes,
                   parts_.orders.sharing(checkpoint.kinds));
}

template <int n>
std::optional<EarlierTables> RunCheckpoints<n>::recall() {
  if (parts_.line.restart.empty()) return {};
  State& state = parts_.state;
  const auto file = checkpoint_file(parts_.line.restart);
  const CheckpointReader reader(file, parts_.processes);
  const Checkpoint& head = reader.head();
  require_same_run(file, head, parts_.program, parts_.case_hash, parts_.loaded.mesh.hash, difference_to(head));
  const State rest = parts_.scene.at_rest();
  RecalledArchive archive(
      file, head,
      {reader.arrays(),
       [&](const std::string& name, ArrayKind kind) { return reader.array(name, parts_.orders.of(kind)); },
       [&](ArrayKind kind) { return parts_.orders.length(kind, rest); }},
      parts_.processes);
  keep_scheme(archive);
  fsi::recall(head, archive, state);
  require_not_beyond(file, state, parts_.setup.time ? parts_.setup.time->end : 1);
  EarlierSteps past{head.step, state.time, state.step - (parts_.lagging() ? 1 : 0), {}};
  for (const ResultTable& table : observers_.tables()) past.digests[table.file];
  PrefixedArchive of_digests(of_tables, archive);
  keep(past.digests, of_digests);
  EarlierTables earlier(parts_.line.restart, observers_.tables(), past);
  StoredSteps steps = recall_steps(archive, state, earlier.times());
  observers_.keep(archive);  // rows may show what a watcher remembers
  if (past.levels > 0) observers_.require_same(parts_.shown_level(), earlier);

  const Stretch before = steps.stretches.back();
  if (parts_.loads.axis().go_on(std::move(steps.stretches), state.step, state.time, std::move(steps.insertions))) {
    archive.change_step();
    step_change_ = text_of_change(before);
  }
  keep_method(archive);
  if (const auto left = archive.require_all_known(others()); !left.empty())
    left_aside_ = fmt::format("of the checkpoint, what the methods of this run do not use: {}", fmt::join(left, ", "));
  warnings_ = archive.warnings();
  if (in_place(parts_.line)) saved_ = state.step;
  return earlier;
}

/// What differs between the case of a checkpoint and this one, for a message.
template <int n>
std::string RunCheckpoints<n>::difference_to(const Checkpoint& head) const {
  std::string difference = difference_of_cases(head.case_text, parts_.case_text);
  const bool frame_differs = difference.rfind("structure.fibre_frame ", 0) == 0;
  if (frame_differs && !parts_.setup.structure->fibre_frame)
    difference +=
        ", which the shape of the wall decides where the case names no frame; structure.fibre_frame names that of the "
        "earlier run";
  const bool start_differs =
      difference.rfind("opening.", 0) == 0 && difference.find(".initial_") < difference.find(' ');
  if (start_differs)
    difference +=
        "; time.start = \"lumped\" finds it, from time.period: continue with the time.start and time.period of the "
        "earlier run";
  return difference;
}

/// "time.step is 0.0625 ms from step 3 on, 0.125 ms before: 8 steps to come"
template <int n>
std::string RunCheckpoints<n>::text_of_change(const Stretch& before) const {
  const Loads& loads = parts_.loads;
  const State& state = parts_.state;
  const double asked = loads.axis().stretches().back().asked;
  if (loads.axis().is_adaptive())
    return fmt::format("time.step is adaptive from step {} on, {:g} ms before", state.step + 1, before.asked);
  if (before.asked == 0)
    return fmt::format("time.step is {:g} ms from step {} on, adaptive before: {} steps to come", asked, state.step + 1,
                       loads.steps() - state.step);
  return loads.axis().is_static()
             ? fmt::format("static.load_steps is {:g} from load step {} on, {:g} before: {} steps to come", asked,
                           state.step + 1, before.asked, loads.steps() - state.step)
             : fmt::format("time.step is {:g} ms from step {} on, {:g} ms before: {} steps to come", asked,
                           state.step + 1, before.asked, loads.steps() - state.step);
}

#define FSI_INSTANTIATE(n) template class RunCheckpoints<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
