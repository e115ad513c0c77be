#include "host/available_memory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

namespace fsi {

namespace {

constexpr std::uint64_t unbounded = std::numeric_limits<std::uint64_t>::max();

constexpr const char* control_group = "its control group";

std::atomic<const char*> doing_now{"starting"};
std::atomic_flag ending = ATOMIC_FLAG_INIT;
thread_local int may_fail = 0;

std::function<void(const std::string&)>& notices() {
  static std::function<void(const std::string&)> sink;
  return sink;
}

/// Reads the beginning of a file as text, by system calls only. \returns whether it could be opened; else `text` is
/// empty
template <std::size_t size>
bool read_text(const char* file, char (&text)[size]) noexcept {
  text[0] = 0;
  const int descriptor = open(file, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  std::size_t length = 0;
  for (ssize_t got = 1; got > 0 && length + 1 < size; length += got > 0 ? static_cast<std::size_t>(got) : 0)
    got = read(descriptor, text + length, size - 1 - length);
  text[length] = 0;
  close(descriptor);
  return true;
}

std::uint64_t difference(std::uint64_t limit, std::uint64_t used) noexcept {
  return limit > used ? limit - used : 0;
}

/// The number behind `key` at the beginning of a line, `otherwise` if there is none.
std::uint64_t number_behind(const char* text, const char* key, std::uint64_t otherwise) noexcept {
  const std::size_t length = std::strlen(key);
  for (const char* line = text; line != nullptr && *line != 0;) {
    if (std::strncmp(line, key, length) == 0) return std::strtoull(line + length, nullptr, 10);
    line = std::strchr(line, '\n');
    if (line != nullptr) ++line;
  }
  return otherwise;
}

/// What one control group leaves: limit minus use, without file pages that can be dropped.
std::uint64_t room_in_group(const char* folder, const char* limit_name, const char* use_name) noexcept {
  char file[1024], text[8192];
  std::snprintf(file, sizeof file, "%s/%s", folder, limit_name);
  if (!read_text(file, text) || text[0] < '0' || text[0] > '9') return unbounded;  // "max"
  const std::uint64_t limit = std::strtoull(text, nullptr, 10);
  if (limit >= unbounded / 4) return unbounded;  // no limit: version 1 says so by a huge number
  std::snprintf(file, sizeof file, "%s/%s", folder, use_name);
  if (!read_text(file, text)) return limit;
  const std::uint64_t used = std::strtoull(text, nullptr, 10);
  std::snprintf(file, sizeof file, "%s/memory.stat", folder);
  read_text(file, text);
  return difference(limit, difference(used, number_behind(text, "inactive_file ", 0)));
}

/// Bytes in a column, from 0, of /proc/self/statm, which counts pages.
std::uint64_t pages(const char* statm, int column) noexcept {
  for (; column > 0 && statm != nullptr; --column) {
    statm = std::strchr(statm, ' ');
    if (statm != nullptr) ++statm;
  }
  return statm == nullptr ? 0 : std::strtoull(statm, nullptr, 10) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void tighten(MemoryRoom& room, std::uint64_t bytes, const char* bound) noexcept {
  if (bytes < room.bytes) room = {bytes, bound};
}

/// The name by which the system knows this process, known before main() too.
void program_name(char (&name)[64]) noexcept {
  if (!read_text("/proc/self/comm", name)) std::snprintf(name, sizeof name, "%s", "fsi");
  if (char* end = std::strchr(name, '\n')) *end = 0;
}

[[noreturn]] void end_with(const char* message) noexcept {
  const std::size_t length = std::strlen(message);
  for (std::size_t done = 0; done < length;) {
    const ssize_t wrote = write(STDERR_FILENO, message + done, length - done);
    if (wrote <= 0 && errno != EINTR) break;
    if (wrote > 0) done += static_cast<std::size_t>(wrote);
  }
  _exit(1);  // no exit handlers: those of libraries would flush what is half done
}

/// The first thread returns; others wait for the end of the process.
void enter_the_end() noexcept {
  if (!ending.test_and_set()) return;
  for (;;) pause();
}

}  // namespace

std::uint64_t machine_room(const char* meminfo) noexcept {
  const std::uint64_t kib = number_behind(meminfo, "MemAvailable:", unbounded);
  return kib == unbounded ? unbounded : (kib + number_behind(meminfo, "SwapFree:", 0)) * 1024;
}

std::uint64_t group_room(const char* groups, const char* root) noexcept {
  std::uint64_t room = unbounded;
  for (const char* line = groups; line != nullptr && *line != 0;) {
    const char* const end = std::strchr(line, '\n') != nullptr ? std::strchr(line, '\n') : line + std::strlen(line);
    const char* const controllers = std::strchr(line, ':');
    const char* const path = controllers != nullptr ? std::strchr(controllers + 1, ':') : nullptr;
    if (path != nullptr && path < end) {
      const bool second = path == controllers + 1;  // version 2 names no controllers
      const bool first = !second && path - controllers == 7 && std::strncmp(controllers, ":memory", 7) == 0;
      if (first || second) {
        char folder[768];
        std::snprintf(folder, sizeof folder, "%s%s%.*s", root, first ? "/memory" : "", static_cast<int>(end - path - 1),
                      path + 1);
        // The limits of all groups above hold as well.
        for (const std::size_t shortest = std::strlen(root) + (first ? 7 : 0);;) {
          room = std::min(room, first ? room_in_group(folder, "memory.limit_in_bytes", "memory.usage_in_bytes")
                                      : room_in_group(folder, "memory.max", "memory.current"));
          char* const slash = std::strrchr(folder, '/');
          if (slash == nullptr || static_cast<std::size_t>(slash - folder) < shortest) break;
          *slash = 0;
        }
      }
    }
    line = *end == 0 ? nullptr : end + 1;
  }
  return room;
}

MemoryRoom available_memory() noexcept {
  MemoryRoom room{unbounded, ""};
  char text[8192];
  if (read_text("/proc/meminfo", text)) tighten(room, machine_room(text), "this machine");
  if (read_text("/proc/self/cgroup", text)) tighten(room, group_room(text, "/sys/fs/cgroup"), control_group);
  const bool sizes = read_text("/proc/self/statm", text);
  rlimit limit{};
  if (sizes && getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    tighten(room, difference(limit.rlim_cur, pages(text, 0)), "ulimit -v");
  if (sizes && getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    tighten(room, difference(limit.rlim_cur, pages(text, 5)), "ulimit -d");
  return room;
}

void write_memory_text(double bytes, char* text, std::size_t size) noexcept {
  constexpr const char* units[] = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  if (bytes < 1024) {
    std::snprintf(text, size, "%.0f bytes", bytes);
    return;
  }
  std::size_t unit = 0;
  for (bytes /= 1024; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1024;
  std::snprintf(text, size, bytes < 10 ? "%.1f %s" : "%.0f %s", bytes, units[unit]);
}

void write_memory_advice(const char* program, const char* bound, char* text, std::size_t size) noexcept {
  const char* const raise = std::strncmp(bound, "ulimit", 6) == 0    ? "a higher limit"
                            : std::strcmp(bound, control_group) == 0 ? "a higher limit of the container or job"
                                                                     : "a machine with more memory";
  if (std::strcmp(program, "fsi-mesh") == 0)
    std::snprintf(text, size, "take a coarser mesh or %s", raise);
  else
    std::snprintf(text, size, "take a coarser mesh, linear_solver = \"fast\", fewer threads (--threads) or %s", raise);
}

void give_back_memory() noexcept {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::string memory_text(double bytes) {
  char text[64];
  write_memory_text(bytes, text, sizeof text);
  return text;
}

namespace {

std::string message_of(const std::string& asked, const std::string& remedy) {
  const MemoryRoom room = available_memory();
  char program[64], advice[256];
  program_name(program);
  write_memory_advice(program, room.bound, advice, sizeof advice);
  return fmt::format("out of memory ({}): {}, {} available ({}); {}", doing_now.load(), asked,
                     memory_text(static_cast<double>(room.bytes)), room.bound, remedy.empty() ? advice : remedy);
}

}  // namespace

OutOfMemory::OutOfMemory(const std::string& asked, const std::string& remedy)
    : std::runtime_error(message_of(asked, remedy)) {}

Activity::Activity(const char* doing) noexcept : before_(doing_now.exchange(doing)) {}
Activity::~Activity() {
  doing_now = before_;
}

MayFail::MayFail() noexcept {
  ++may_fail;
}
MayFail::~MayFail() {
  --may_fail;
}
bool MayFail::now() noexcept {
  return may_fail > 0;
}

void end_out_of_memory(std::size_t asked) noexcept {
  enter_the_end();
  const MemoryRoom room = available_memory();
  char program[64], advice[256], size[64], left[64], message[1024];
  program_name(program);
  write_memory_advice(program, room.bound, advice, sizeof advice);
  write_memory_text(static_cast<double>(asked), size, sizeof size);
  write_memory_text(static_cast<double>(room.bytes), left, sizeof left);
  std::snprintf(message, sizeof message, "%s: error: out of memory (%s): %s%s%s available (%s); %s\n", program,
                doing_now.load(), asked > 0 ? size : "", asked > 0 ? " asked, " : "", left, room.bound, advice);
  end_with(message);
}

void end_out_of_memory(const std::string& program, const OutOfMemory& error) noexcept {
  enter_the_end();
  std::fflush(stdout);
  char message[2048];
  std::snprintf(message, sizeof message, "%s: error: %s\n", program.c_str(), error.what());
  end_with(message);
}

void end_without_thread() noexcept {
  enter_the_end();
  char program[64], message[1024];
  program_name(program);
  std::snprintf(message, sizeof message,
                "%s: error: a thread cannot be started (%s): there is no memory for its stack, or a limit of processes "
                "is reached; give fewer threads (--threads), or raise the limits (ulimit -v, ulimit -u)\n",
                program, doing_now.load());
  end_with(message);
}

void set_memory_notices(std::function<void(const std::string&)> sink) {
  notices() = std::move(sink);
}

void memory_notice(const std::string& text) {
  if (notices()) notices()(text);
}

}  // namespace fsi
