#pragma once

#include <exception>
#include <functional>

#include "parallel/communicator.hpp"

namespace fsi {

/// Makes all processes fail if one does: if one passes an exception, all throw one of the same kind (InputError,
/// WriteError, ConvergenceError, OutOfMemory, any other as std::runtime_error) with the message of the first process that
/// failed, so that all end alike. For all processes together; a single process rethrows its exception.
/// \param mine  null: this process has not failed
void agree_on_failure(const Communicator& processes, const std::exception_ptr& mine);

/// Runs the action at each process, then agree_on_failure(). The action must not wait for other processes after a point
/// where it may have failed.
void do_together(const Communicator& processes, const std::function<void()>& action);

/// Runs the action, such as writing a table, at the first process only; the others wait for it and throw what it
/// throws.
void at_first(const Communicator& processes, const std::function<void()>& action);

/// Work that the first process does for all while the others go on; they learn of a failure later, by agree().
class FirstProcess {
 public:
  /// \param processes  must outlive this
  explicit FirstProcess(const Communicator& processes) : processes_(processes) {}
  FirstProcess(const FirstProcess&) = delete;
  FirstProcess& operator=(const FirstProcess&) = delete;
  /// For a program without other processes.
  static FirstProcess& alone();

  const Communicator& processes() const { return processes_; }
  bool is_here() const { return processes_.is_first(); }

  /// As at_first().
  void now(const std::function<void()>& action) { at_first(processes_, action); }
  /// Runs the action at the first process only. An InputError is kept for agree(), and no further action runs until
  /// then; a single process throws it at once.
  void later(const std::function<void()>& action);
  /// For all processes together: throws at all of them what the first has kept.
  void agree();

 private:
  const Communicator& processes_;
  std::exception_ptr failure_;
};

}  // namespace fsi
