#pragma once

#include <exception>
#include <functional>

#include "parallel/communicator.hpp"

namespace fsi {

/// Lets all processes know whether one of them has failed: where one hands over an exception, all throw one of the same
/// kind (InputError, WriteError, ConvergenceError, others) with the message of the first process that failed. So all
/// end alike, and in order. For all processes together; alone, throws what it is given.
/// \param mine  null: this process has not failed
void agree_on_failure(const Communicator& processes, const std::exception_ptr& mine);

/// Each process does its part; if one fails, all do, after that. The action must not wait for other processes once it
/// may have failed.
void do_together(const Communicator& processes, const std::function<void()>& action);

/// What one process does for all, such as writing a table: the first does it, the others wait for it and throw what it
/// throws. Alone, just does it.
void at_first(const Communicator& processes, const std::function<void()>& action);

/// Work that the first process does for all while these go on: they are told later of a failure, when all agree on it.
class FirstProcess {
 public:
  /// \param processes  must outlive this
  explicit FirstProcess(const Communicator& processes) : processes_(processes) {}
  FirstProcess(const FirstProcess&) = delete;
  FirstProcess& operator=(const FirstProcess&) = delete;
  /// Of a program that works by itself.
  static FirstProcess& alone();

  const Communicator& processes() const { return processes_; }
  bool is_here() const { return processes_.is_first(); }

  /// As at_first().
  void now(const std::function<void()>& action) { at_first(processes_, action); }
  /// At the first process, at others nothing. An InputError is kept for agree(), and nothing more is done until then;
  /// alone it is thrown at once.
  void later(const std::function<void()>& action);
  /// For all together: throws at all of them what the first has kept.
  void agree();

 private:
  const Communicator& processes_;
  std::exception_ptr failure_;
};

}  // namespace fsi
