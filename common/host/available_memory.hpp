#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace fsi {

/// Memory that this process may still take.
struct MemoryRoom {
  std::uint64_t bytes = 0;
  const char* bound = "";  ///< what sets it: "ulimit -v", "its control group", "this machine"; empty: not known
};

/// The least of what the limits of this process (ulimit -v, ulimit -d), its control groups and the machine
/// (MemAvailable and free swap) leave. Allocates nothing; what cannot be read sets no bound.
MemoryRoom available_memory() noexcept;

/// MemAvailable plus SwapFree in the text of /proc/meminfo, bytes; the largest number if it has no MemAvailable.
std::uint64_t machine_room(const char* meminfo) noexcept;
/// What the control groups leave, bytes; the largest number where they set no limit.
/// \param groups  text of /proc/self/cgroup
/// \param root    where they are mounted, /sys/fs/cgroup
std::uint64_t group_room(const char* groups, const char* root) noexcept;

/// Returns freed heap memory to the system, so that it does not add to later peaks. For the end of a stage that has
/// taken much. Does nothing without glibc.
void give_back_memory() noexcept;

/// "3.1 GiB", "80 bytes".
std::string memory_text(double bytes);
/// The same into `text`; allocates nothing.
void write_memory_text(double bytes, char* text, std::size_t size) noexcept;

/// What helps a program, by the bound of available_memory(), into `text`; allocates nothing.
void write_memory_advice(const char* program, const char* bound, char* text, std::size_t size) noexcept;

/// Memory ran out, or would. Programs print what() and exit with code 1.
/// The message reads `out of memory (DOING): ASKED, ROOM available (BOUND); REMEDY`, DOING being the current activity.
class OutOfMemory : public std::runtime_error {
 public:
  /// \param asked   what was asked for, e.g. "3.1 GiB asked"
  /// \param remedy  what would help; empty: the advice of this program
  explicit OutOfMemory(const std::string& asked, const std::string& remedy = "");
};

/// Names what the program does while this lives, for messages when memory runs out. On the main thread, outside
/// parallel regions.
class Activity {
 public:
  /// \param doing  lives as long as this, e.g. "reading the mesh"
  explicit Activity(const char* doing) noexcept;
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

 private:
  const char* before_;
};

/// Allocations of this thread that fail while this lives return null instead of ending the program
/// (host/memory_guard.cpp): for callers that handle it.
class MayFail {
 public:
  MayFail() noexcept;
  ~MayFail();
  MayFail(const MayFail&) = delete;
  MayFail& operator=(const MayFail&) = delete;
  /// Whether one lives on this thread.
  static bool now() noexcept;
};

/// Ends the process with exit code 1 and the message of OutOfMemory, written at once to standard error. For where
/// nothing can be thrown: inside libraries, parallel regions, signal handlers. Allocates nothing; if several threads
/// call it, one prints.
/// \param asked  bytes, 0: not known
[[noreturn]] void end_out_of_memory(std::size_t asked) noexcept;
/// The same for an OutOfMemory caught at the end of main(). Returning from main() would not do: another thread may have
/// failed meanwhile and waits for the end.
/// \param program  name that the message begins with
[[noreturn]] void end_out_of_memory(const std::string& program, const OutOfMemory& error) noexcept;
/// The same when a thread could not be started.
[[noreturn]] void end_without_thread() noexcept;

/// Sets where notices about memory go (a run's log); without a sink they are dropped.
void set_memory_notices(std::function<void(const std::string&)> sink);
void memory_notice(const std::string& text);

}  // namespace fsi
