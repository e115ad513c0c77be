#pragma once

#include <exception>
#include <functional>

#include "parallel/communicator.hpp"

namespace fsi {

/// Lets all processes know whether one of them has failed: where one hands over an exception, all throw one of the same
/// kind (InputError, WriteError, ConvergenceError, others) with what the first of those who failed has to say. So all
/// end alike, and in order. For all processes together; alone, throws what it is given.
/// \param mine  null: this process has not failed
void agree_on_failure(const Communicator& processes, const std::exception_ptr& mine);

/// Each process does its part; if one fails, all do, after that. The action must not wait for other processes once it
/// may have failed.
void do_together(const Communicator& processes, const std::function<void()>& action);

/// What one process does for all, such as writing a table: the first does it, the others wait for it and throw what it
/// throws. Alone, just does it.
void at_first(const Communicator& processes, const std::function<void()>& action);

}  // namespace fsi
