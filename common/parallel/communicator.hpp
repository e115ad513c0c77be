#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace fsi {

/// Communication of this process so far. Barriers and the counts of send_and_receive() are not counted.
struct Traffic {
  std::int64_t messages = 0;    ///< sent to neighbours
  std::int64_t bytes = 0;       ///< in them
  std::int64_t reductions = 0;  ///< sums, gathers and broadcasts over all processes
};

/// The processes that solve one scene together, as seen by one of them. What all are asked for must be called by all,
/// in one order. Alone, all but sum_before() return what they were given. Sums are formed in the order of the
/// processes, so that all get the same bits, and a run with the same number of processes gets them again.
class Communicator {
 public:
  /// This process by itself.
  static const Communicator& alone();
  /// All processes of the program; alone() where it was started by itself (ProcessGroup).
  static const Communicator& world();

  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  ~Communicator();

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_alone() const { return size_ == 1; }
  bool is_first() const { return rank_ == 0; }

  double sum(double mine) const;
  std::int64_t sum(std::int64_t mine) const;
  /// Each number by itself, in one message.
  void sum(double* mine, std::size_t count) const;
  void sum(std::vector<double>& mine) const { sum(mine.data(), mine.size()); }
  double smallest(double mine) const;  ///< NaN if one is
  double largest(double mine) const;   ///< NaN if one is
  bool any(bool mine) const;
  /// The sum over the processes before this one; 0 at the first.
  std::int64_t sum_before(std::int64_t mine) const;

  /// One entry a process, in their order, at all of them.
  std::vector<double> gather(double mine) const;
  std::vector<std::int64_t> gather(std::int64_t mine) const;
  /// One after the other in the order of the processes, of any lengths, at all of them.
  std::vector<double> gather(const std::vector<double>& mine) const;
  std::vector<std::int64_t> gather(const std::vector<std::int64_t>& mine) const;
  std::vector<int> gather(const std::vector<int>& mine) const;
  /// The same of lengths that all know. \param counts  per process \param all  has room for their sum
  void gather(const float* mine, const std::vector<int>& counts, float* all) const;
  /// gather() of lists of any lengths, at the first process alone; empty at the others.
  std::vector<double> gather_at_first(const std::vector<double>& mine) const;

  /// What the first process has, at all of them.
  void broadcast(std::string& text) const;
  void broadcast(std::vector<double>& numbers) const;
  void broadcast(std::int64_t& number) const;

  /// Returns when all processes have called it.
  void wait() const;

  /// Numbers for other processes, one list for each of them; returns what they have for this one.
  std::vector<std::vector<double>> send_and_receive(const std::vector<std::vector<double>>& to_each) const;

  const Traffic& traffic() const { return traffic_; }

  /// Beneath it, for callers that use MPI (parallel/mpi_handle.hpp).
  struct Handle;
  const Handle* handle() const { return handle_.get(); }

 private:
  friend class ProcessGroup;
  friend class Exchange;
  explicit Communicator(std::unique_ptr<Handle> handle);

  /// Of as many numbers from each.
  std::vector<double> gather_equal(const double* mine, std::size_t count) const;

  std::unique_ptr<Handle> handle_;  ///< null: alone
  int rank_ = 0, size_ = 1;
  mutable Traffic traffic_;
};

/// The life of the program among other processes: MPI begins with it and ends with it, where a launcher started the
/// program. Without a launcher nothing is begun: a run by itself costs nothing.
class ProcessGroup {
 public:
  /// \throws InputError  in a build without MPI that was launched as several processes
  ProcessGroup();
  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  /// Begins MPI for this process by itself where that has not happened, for libraries that need it.
  /// \throws std::logic_error in a build without MPI
  static void require_mpi();

  /// Ends all processes at once, with this code: for errors that only some of them have met.
  [[noreturn]] static void abort(int exit_code);
};

}  // namespace fsi
