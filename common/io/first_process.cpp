#include "io/first_process.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "io/write_error.hpp"

namespace fsi {

namespace {

enum class Kind { none, bad_input, not_written, not_converged, out_of_memory, other };

/// An error with the message of another process, which is not to be shortened again.
template <class Error>
class SaidElsewhere : public Error {
 public:
  SaidElsewhere(Error error, std::string said) : Error(std::move(error)), said_(std::move(said)) {}
  const char* what() const noexcept override { return said_.c_str(); }

 private:
  std::string said_;
};

struct Failure {
  Kind kind = Kind::none;
  std::vector<std::string> parts{};  ///< of a WriteError its file, key, reason and remedy; else the message
};

Failure failure_of(const std::exception_ptr& exception) {
  if (!exception) return {};
  try {
    std::rethrow_exception(exception);
  } catch (const WriteError& error) {
    return {Kind::not_written, {error.file().string(), error.key(), error.reason(), error.remedy()}};
  } catch (const InputError& error) {
    return {Kind::bad_input, {error.what()}};
  } catch (const ConvergenceError& error) {
    return {Kind::not_converged, {error.what()}};
  } catch (const OutOfMemory& error) {
    return {Kind::out_of_memory, {error.what()}};
  } catch (const std::exception& error) {
    return {Kind::other, {error.what()}};
  } catch (...) {
    return {Kind::other, {"unknown exception"}};
  }
}

const std::string named_in_text;  // no file: the message has it

[[noreturn]] void throw_again(const Failure& failure) {
  const std::string& said = failure.parts.at(0);
  switch (failure.kind) {
    case Kind::not_written:
      throw WriteError(said, failure.parts.at(1), failure.parts.at(2), failure.parts.at(3));
    case Kind::bad_input:
      throw SaidElsewhere<InputError>(InputError(named_in_text, "", said, ""), said);
    case Kind::not_converged:
      throw SaidElsewhere<ConvergenceError>(ConvergenceError(said, ""), said);
    case Kind::out_of_memory:
      throw SaidElsewhere<OutOfMemory>(OutOfMemory(""), said);
    default:
      throw std::runtime_error(said);
  }
}

/// The failure of process `rank`, at all processes. Each text is sent as its length and characters.
Failure shared(const Communicator& processes, int rank, Kind kind, const Failure& mine) {
  std::vector<int> numbers;
  if (processes.rank() == rank)
    for (const std::string& part : mine.parts) {
      numbers.push_back(static_cast<int>(part.size()));
      numbers.insert(numbers.end(), part.begin(), part.end());
    }
  numbers = processes.gather(numbers);
  Failure failure{kind};
  for (auto at = numbers.begin(); at != numbers.end();) {
    const int length = *at++;
    failure.parts.emplace_back(at, at + length);
    at += length;
  }
  return failure;
}

std::exception_ptr exception_of(const std::function<void()>& action) {
  try {
    action();
  } catch (...) {
    return std::current_exception();
  }
  return {};
}

}  // namespace

void agree_on_failure(const Communicator& processes, const std::exception_ptr& mine) {
  if (processes.is_alone()) {
    if (mine) std::rethrow_exception(mine);
    return;
  }
  const Failure failure = failure_of(mine);
  const auto kinds = processes.gather(static_cast<std::int64_t>(failure.kind));
  for (int rank = 0; rank < processes.size(); ++rank)
    if (const auto kind = static_cast<Kind>(kinds[static_cast<std::size_t>(rank)]); kind != Kind::none)
      throw_again(shared(processes, rank, kind, failure));
}

void do_together(const Communicator& processes, const std::function<void()>& action) {
  if (processes.is_alone())
    action();
  else
    agree_on_failure(processes, exception_of(action));
}

void at_first(const Communicator& processes, const std::function<void()>& action) {
  do_together(processes, [&] {
    if (processes.is_first()) action();
  });
}

FirstProcess& FirstProcess::alone() {
  static FirstProcess by_itself(Communicator::alone());
  return by_itself;
}

void FirstProcess::later(const std::function<void()>& action) {
  if (processes_.is_alone()) return action();
  if (!is_here() || failure_) return;
  try {
    action();
  } catch (const InputError&) {
    failure_ = std::current_exception();
  }
}

void FirstProcess::agree() {
  if (!processes_.is_alone()) agree_on_failure(processes_, std::exchange(failure_, {}));
}

}  // namespace fsi
