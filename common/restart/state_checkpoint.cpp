#include "restart/state_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "base/error.hpp"
#include "time/time_rounding.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

constexpr const char* insertions_name = "inserted_steps";  // each: step, its end, its length
constexpr const char* inserted_until = "inserted_until";   // steps 1 to this were all inserted: iterations.csv has them
constexpr const char* stretches_name = "step_lengths";  // per stretch: step before it, its start, what the case asked
constexpr const char* level_times = "level_times";
constexpr const char* balance_times = "balance_times";
constexpr const char* since_jump = "since_jump";
constexpr const char* from_another_folder = "restart from a folder as its run has left it, or run from the start";

/// An array whose length the scene decides: it stays what it is.
void keep_sized(const std::string& name, ArrayKind kind, std::vector<double>& values, RestartArchive& archive) {
  archive.array(name, kind, values, {values.size()});
}

/// \param branches  whether there are Maxwell branches in the scene
void keep_fields(const std::string& name, Solution& fields, bool branches, RestartArchive& archive) {
  keep_sized(name + ".mesh", ArrayKind::mesh, fields.mesh, archive);
  keep_sized(name + ".flow", ArrayKind::flow, fields.fluid, archive);
  keep_sized(name + ".wall", ArrayKind::wall, fields.wall, archive);
  if (!fields.openings.empty()) keep_sized(name + ".windkessel", ArrayKind::opening_values, fields.openings, archive);
  if (branches) keep_sized(name + ".branches", ArrayKind::wall_branches, fields.branches, archive);
}

template <std::size_t count>
void keep_times(const char* name, std::array<double, count>& times, RestartArchive& archive) {
  std::vector<double> numbers(times.begin(), times.end());
  keep_sized(name, ArrayKind::alike, numbers, archive);
  std::copy(numbers.begin(), numbers.end(), times.begin());
}

/// A whole number among doubles.
int whole(const fs::path& file, const std::string& name, double number, double least, double most) {
  require_in({least, most, true}, number, file, name);
  return static_cast<int>(number);
}

/// The steps that led to a checkpoint, as numbers.
struct StepNumbers {
  std::vector<double> stretches, inserted;  ///< three for each
  std::int64_t told = 0;                    ///< by iterations.csv

  void keep(RestartArchive& archive) {
    archive.array(stretches_name, ArrayKind::alike, stretches);
    if (archive.recalls() ? archive.has(inserted_until) : told > 0) archive.integer(inserted_until, told, count_range);
    if (archive.recalls() ? archive.has(insertions_name) : !inserted.empty())
      archive.array(insertions_name, ArrayKind::alike, inserted);
  }
};

/// Times of levels, or balances, the latest first: as many as there are steps, descending, and 0 before the first.
template <std::size_t count>
void require_descending(const fs::path& file, const char* name, const std::array<double, count>& times, double latest) {
  double after = latest * (1 + time_rounding);
  for (const double time : times) {
    if (!(time >= 0 && time <= after) || (time == after && time > 0))
      refuse_entry(file, name, fmt::format("holds {:g} before {:g}: times are out of order", time, after));
    after = time;
  }
}

void require_threes(const fs::path& file, const std::string& name, const std::vector<double>& numbers) {
  if (numbers.size() % 3 != 0) refuse_entry(file, name, fmt::format("has {} values, not three each", numbers.size()));
}

std::vector<Stretch> stored_stretches(const fs::path& file, const std::vector<double>& numbers, const State& state) {
  require_threes(file, stretches_name, numbers);
  if (numbers.empty()) refuse_entry(file, stretches_name, "is empty");
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Stretch stretch{whole(file, stretches_name, numbers[i], 0, state.step), numbers[i + 1], numbers[i + 2]};
    const bool first = stretches.empty();
    if (!(stretch.asked >= 0) || !(stretch.start >= 0 && stretch.start <= state.time * (1 + time_rounding)) ||
        (first && stretch.after != 0) ||
        (!first && (stretch.after <= stretches.back().after || !(stretch.start > stretches.back().start))))
      refuse_entry(file, stretches_name, fmt::format("stretch {} is out of order", stretches.size() + 1));
    stretches.push_back(stretch);
  }
  return stretches;
}

std::vector<Insertion> stored_insertions(const fs::path& file, const StepNumbers& stored, const State& state,
                                         const std::vector<double>& ends) {
  std::vector<Insertion> insertions;
  const int last = whole(file, inserted_until, static_cast<double>(stored.told), 0, state.step);
  for (int step = 1; step <= last; ++step) {
    const double start = step == 1 ? 0 : ends[step - 2];
    insertions.push_back({step, ends[step - 1], ends[step - 1] - start});
  }
  const auto& numbers = stored.inserted;
  require_threes(file, insertions_name, numbers);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const Insertion step{whole(file, insertions_name, numbers[i], 1, count_range.most), numbers[i + 1], numbers[i + 2]};
    const bool finished = step.step <= state.step;
    const double end = finished ? ends[step.step - 1] : state.time;
    if (!(step.length > 0) || (finished ? std::abs(step.end - end) > time_rounding * end : step.end <= end) ||
        (!insertions.empty() && (step.step <= insertions.back().step || step.end <= insertions.back().end)))
      refuse_entry(file, insertions_name, fmt::format("step {} is out of order", step.step));
    insertions.push_back(step);
  }
  return insertions;
}

}  // namespace

void keep(State& state, RestartArchive& archive) {
  keep_times(level_times, state.times, archive);
  for (std::size_t level = 0; level < state.before.size(); ++level)
    keep_fields(fmt::format("level{}", level), state.before[level], state.has_branches, archive);
  keep_sized("wall_velocity", ArrayKind::wall_vectors, state.wall_velocity, archive);
  keep_sized("wall_acceleration", ArrayKind::wall_vectors, state.wall_acceleration, archive);
  if (!state.has_balances()) return;  // backward Euler has no more
  keep_times(balance_times, state.balance_times, archive);
  std::vector<double> counts{static_cast<double>(state.since_jump), static_cast<double>(state.balances_since_jump)};
  archive.array(since_jump, ArrayKind::alike, counts, {counts.size(), {}, counts.size(), count_range});
  state.since_jump = static_cast<int>(counts[0]);
  state.balances_since_jump = static_cast<int>(counts[1]);
  for (std::size_t k = 0; k < state.balances.size(); ++k)
    keep_fields(fmt::format("balance{}", k), state.balances[k], state.has_branches, archive);
  keep_sized("wall_velocity_before", ArrayKind::wall_vectors, state.wall_velocity_before, archive);
  keep_fields("rate", state.rate, state.has_branches && !state.rate.wall.empty(), archive);
  keep_sized("rate.wall_velocity", ArrayKind::wall_vectors, state.velocity_rate, archive);
  keep_sized("rate.loads", ArrayKind::alike, state.load_rates, archive);
}

void recall(const Checkpoint& head, RecalledArchive& archive, State& state) {
  const fs::path& file = archive.file();
  if (!std::isfinite(head.time)) refuse_entry(file, "time", "is not finite");
  if (head.step < 1 || static_cast<double>(head.step) > count_range.most)
    refuse_entry(file, "step", fmt::format("is {}, not from 1 to {}", head.step, count_range.most));
  if (!(head.time > 0)) refuse_entry(file, "time", fmt::format("is {:g}, not positive", head.time));
  keep(state, archive);
  state.step = static_cast<int>(head.step);
  state.time = head.time;
  if (state.has_balances()) {
    require_descending(file, balance_times, state.balance_times, state.time);
    require_in({0, static_cast<double>(state.step), true}, state.since_jump, file, since_jump);
    // One balance a step, or two.
    require_in({static_cast<double>(state.since_jump), 2.0 * state.since_jump, true}, state.balances_since_jump, file,
               since_jump);
  }
  state.now = state.before[0];
}

void write_down_steps(const TimeAxis& axis, const State& state, RestartArchive& archive) {
  StepNumbers steps;
  // An adaptive step that found no solution leaves a plan from its own end on.
  for (const Stretch& stretch : axis.stretches())
    steps.stretches.insert(steps.stretches.end(),
                           {static_cast<double>(stretch.after), std::min(stretch.start, state.time), stretch.asked});
  // The ends of adaptive steps are in iterations.csv, so that a checkpoint does not grow with their number. The last
  // one keeps its length to the last bit.
  const auto& insertions = axis.insertions();
  std::size_t told = 0;
  while (told < insertions.size() && insertions[told].step == static_cast<int>(told) + 1 &&
         insertions[told].step < state.step)
    ++told;
  steps.told = static_cast<std::int64_t>(told);
  for (std::size_t i = told; i < insertions.size(); ++i)
    steps.inserted.insert(steps.inserted.end(),
                          {static_cast<double>(insertions[i].step), insertions[i].end, insertions[i].length});
  steps.keep(archive);
}

StoredSteps recall_steps(RecalledArchive& archive, const State& state, const std::vector<double>& ends) {
  const fs::path& file = archive.file();
  for (std::size_t k = 0; k < state.times.size(); ++k) {
    const int step = state.step - static_cast<int>(k);
    const double end = step > 0 ? ends.at(step - 1) : 0;
    if (std::abs(state.times[k] - end) > time_rounding * end)
      throw InputError(
          file.string(), level_times,
          fmt::format("says that step {} ended at {:.12g}, iterations.csv at {:.12g}", step, state.times[k], end),
          from_another_folder);
  }
  StepNumbers stored;
  stored.keep(archive);
  StoredSteps steps{stored_stretches(file, stored.stretches, state), stored_insertions(file, stored, state, ends)};
  // Adaptive steps are all inserted, the last one with its own length.
  const auto last = static_cast<std::size_t>(state.step);
  if (steps.stretches.back().asked == 0 &&
      (steps.insertions.size() < last || steps.insertions[last - 1].step != state.step || stored.told >= state.step))
    refuse_entry(file, insertions_name, fmt::format("lacks one of the {} adaptive steps", state.step));
  return steps;
}

void keep(TableDigests& digests, RestartArchive& archive) {
  for (auto entry = digests.begin(); entry != digests.end();) {
    const bool wanted = archive.wants({entry->first});
    if (wanted) archive.array(entry->first, ArrayKind::alike, entry->second);
    entry = wanted ? std::next(entry) : digests.erase(entry);
  }
}

void require_not_beyond(const fs::path& file, const State& state, double end) {
  if (state.time > end * (1 + time_rounding))
    throw InputError(file.string(), "time", fmt::format("{:g} ms, is behind the run's end at {:g} ms", state.time, end),
                     fmt::format("give time.end = {:g} or more", state.time));
}

}  // namespace fsi
