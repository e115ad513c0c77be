#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/error.hpp"
#include "base/output_file.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

// Another run may be about to write its name, or a look at the lock may hold it for a moment.
constexpr int tries = 300;
constexpr useconds_t pause_microseconds = 10'000;

/// Which process holds a lock.
struct Holder {
  std::string program, host, boot;  ///< `boot`: the kernel's name for the time since the host was started
  long process = 0;
  unsigned long long start = 0;  ///< of the process, in ticks since the host was started
};

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "unknown";
}

std::string boot_name() {
  return first_line("/proc/sys/kernel/random/boot_id");
}

/// When a process was started (proc(5), field 22); 0: there is no such process.
unsigned long long start_of(long process) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", process));
  const auto name_end = line.rfind(')');  // the second field, which may hold anything
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(line.substr(name_end + 1));
  std::string skipped;
  char state = 0;
  unsigned long long start = 0;
  fields >> state;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  fields >> start;
  return state == 'Z' || state == 'X' ? 0 : start;  // ended, and not yet asked for its exit code
}

Holder this_process(const std::string& program) {
  return {program, host_name(), boot_name(), getpid(), start_of(getpid())};
}

std::string text_of(const Holder& h) {
  return fmt::format("program {}\nhost {}\nprocess {}\nstart {}\nboot {}\n", h.program, h.host, h.process, h.start,
                     h.boot);
}

/// \returns whether the text is that of a lock
bool parse(const std::string& text, Holder& holder) {
  std::istringstream lines(text);
  int found = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto space = line.find(' ');
    if (space == std::string::npos) continue;
    const auto key = line.substr(0, space), value = line.substr(space + 1);
    std::istringstream number(value);
    if (key == "program")
      holder.program = value, ++found;
    else if (key == "host")
      holder.host = value, ++found;
    else if (key == "boot")
      holder.boot = value;
    else if (key == "process")
      found += static_cast<bool>(number >> holder.process);
    else if (key == "start")
      found += static_cast<bool>(number >> holder.start);
  }
  return found == 4 && holder.process > 0;
}

std::string contents_of(int descriptor) {
  std::array<char, 4096> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
}

/// Whether a process of this host still runs, and is the one that was meant and not a later one of the same number.
bool runs(const Holder& holder) {
  if (holder.boot != boot_name()) return false;
  if (const auto start = start_of(holder.process); start != 0 || fs::exists("/proc/self/stat"))
    return start != 0 && start == holder.start;
  return ::kill(static_cast<pid_t>(holder.process), 0) == 0 || errno == EPERM;
}

std::string name_of(const Holder& holder) {
  return fmt::format("{}, process {} on host {}", holder.program, holder.process, holder.host);
}

enum class LockState {
  free,     ///< nobody's
  left,     ///< of a process of this host that has ended
  held,     ///< of a process that runs
  foreign,  ///< of another host
  unknown   ///< it does not say whose
};

/// \param lock     contents of the file
/// \param blocked  whether a process holds the kernel's lock on it
LockState state_of(const std::string& lock, bool blocked, Holder& holder) {
  if (lock.empty()) return blocked ? LockState::unknown : LockState::free;
  if (!parse(lock, holder)) return LockState::unknown;
  if (holder.host != host_name()) return blocked ? LockState::held : LockState::foreign;
  return runs(holder) ? LockState::held : LockState::left;
}

[[noreturn]] void refuse(const fs::path& folder, LockState state, const Holder& holder, const std::string& remedy) {
  const std::string file = (folder / lock_name).string();
  if (state == LockState::foreign)
    throw InputError(folder.string(), "",
                     "is locked by " + name_of(holder) + "; from here it cannot be seen whether that still runs",
                     "if it does not, remove " + file);
  if (state == LockState::unknown)
    throw InputError(folder.string(), "", "is locked, and " + file + " does not say by whom",
                     "if no run works in the folder, remove that file");
  throw InputError(folder.string(), "", "a run works in it (" + name_of(holder) + ")", remedy);
}

[[noreturn]] void refuse_writing(const fs::path& folder, int error) {
  throw InputError(folder.string(), "", std::string("cannot be written (") + std::strerror(error) + ")",
                   "give -o a folder that you may write, on a disk with space");
}

}  // namespace

std::vector<fs::path> make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder.string(), "", "is a file", "give a folder to -o");
  std::vector<fs::path> missing;
  for (fs::path above = folder; !above.empty() && fs::symlink_status(above, error).type() == fs::file_type::not_found;
       above = above.parent_path())
    missing.push_back(above);
  error.clear();
  fs::create_directories(folder, error);
  if (error)
    throw InputError(folder.string(), "", "cannot be created (" + error.message() + ")",
                     "give -o a folder that you may write");
  return missing;
}

FolderLock::FolderLock(const fs::path& folder, const std::string& program)
    : folder_(folder), file_(folder / lock_name) {
  try {
    for (int count = 0; !take(program); ++count) {
      if (count == tries) {
        Holder holder;
        std::ifstream stream(file_);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        refuse(folder_, parse(text, holder) ? LockState::held : LockState::unknown, holder, "wait for its end");
      }
      ::usleep(pause_microseconds);
    }
  } catch (...) {
    release();
    throw;
  }
}

FolderLock::~FolderLock() {
  release();
}

/// One try. \returns false when another may succeed
bool FolderLock::take(const std::string& program) {
  const SignalsWait until_it_is_kept_for_removal;
  const auto made = make_folder(folder_);
  if (!made.empty()) made_ = made;  // anew, when another run has removed what it had made
  require_regular_or_absent(file_, false);
  bool created = true;
  constexpr int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  descriptor_ = ::open(file_.c_str(), flags | O_CREAT | O_EXCL, 0666);
  if (descriptor_ < 0 && errno == EEXIST) {
    created = false;
    descriptor_ = ::open(file_.c_str(), flags);
  }
  if (descriptor_ < 0) {
    if (errno == ENOENT) return false;  // the lock, or the folder, was removed by its owner in between
    refuse_writing(folder_, errno);
  }
  const auto give_up = [&] {
    ::close(descriptor_);
    descriptor_ = -1;
    return false;
  };

  bool blocked = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0;
  kernel_locks_ = !blocked || errno == EWOULDBLOCK;
  if (!kernel_locks_) blocked = !created;
  const std::string lock = contents_of(descriptor_);
  Holder holder;
  const LockState state = state_of(lock, blocked, holder);
  if (blocked && state == LockState::held) {
    give_up();
    refuse(folder_, state, holder, "wait for its end, or give -o another folder");
  }
  if (blocked && kernel_locks_) return give_up();  // its owner is about to write its name, or to remove it
  if (!is_ours()) return give_up();                // removed by its owner after it was opened here
  if (state == LockState::held || state == LockState::foreign || (state == LockState::unknown && kernel_locks_)) {
    give_up();
    refuse(folder_, state, holder, "wait for its end, or give -o another folder");
  }
  if (state == LockState::left)
    said_ = folder_.string() + ": took over the lock of " + name_of(holder) + ", which has ended";
  if (!kernel_locks_ && !created) {
    if (state == LockState::left) ::unlink(file_.c_str());
    return give_up();
  }

  on_signal_.clear();
  for (auto above = made_.rbegin(); above != made_.rend(); ++above) on_signal_.emplace_back(*above);
  on_signal_.emplace_back(file_);
  const std::string text = text_of(this_process(program));
  const bool written = ::ftruncate(descriptor_, 0) == 0 &&
                       ::pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
  if (!written) refuse_writing(folder_, errno);
  return true;
}

bool FolderLock::is_ours() const {
  struct stat own {
  }, there{};
  return descriptor_ >= 0 && ::fstat(descriptor_, &own) == 0 && ::lstat(file_.c_str(), &there) == 0 &&
         own.st_ino == there.st_ino && own.st_dev == there.st_dev;
}

void FolderLock::require_held() const {
  if (!is_ours())
    throw InputError(file_.string(), "", "has been removed while the run went on, and perhaps results with it",
                     "leave the folder of a run alone; start again, or restart from its checkpoint");
}

void FolderLock::release() {
  const SignalsWait until_it_is_removed;
  if (is_ours()) ::unlink(file_.c_str());  // before the kernel's lock is given up: whoever waits for it looks again
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  on_signal_.clear();
  for (const auto& made : made_) ::rmdir(made.c_str());  // only empty ones go
  made_.clear();
}

void require_no_run_in(const fs::path& folder, const std::string& remedy) {
  const fs::path file = folder / lock_name;
  for (int count = 0;; ++count) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return;  // none, or what cannot be read: to write there would fail as well
    const bool blocked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    const std::string lock = contents_of(descriptor);
    ::close(descriptor);
    Holder holder;
    const LockState state = state_of(lock, blocked, holder);
    if (state == LockState::free) return;
    if (state == LockState::left && !blocked) return;
    if (state == LockState::held || state == LockState::foreign || count == tries)
      refuse(folder, state, holder, remedy);
    if (state == LockState::unknown && !blocked && !lock.empty()) refuse(folder, state, holder, remedy);
    ::usleep(pause_microseconds);
  }
}

}  // namespace fsi
