#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/error.hpp"
#include "base/output_file.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

// A file without text is about to get it, or to be removed. A locked one may be so for a moment, by
// require_no_run_in().
constexpr int tries_without_text = 300, tries_with_text = 20;
constexpr useconds_t pause_microseconds = 10'000;
constexpr int open_flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "unknown";
}

std::string on_this_host() {
  return " on host " + host_name();
}

std::string contents_of(int descriptor) {
  std::array<char, 4096> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
}

/// The process that a lock's text names; empty where it names none.
std::string holder_in(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.find(", process ") < line.find(" on host ") && line.find(" on host ") != std::string::npos ? line : "";
}

enum class KernelLock { taken, of_another, unsupported };

/// \param operation  LOCK_EX or LOCK_SH
KernelLock try_kernel_lock(int descriptor, int operation) {
  if (::flock(descriptor, operation | LOCK_NB) == 0) return KernelLock::taken;
  return errno == EWOULDBLOCK ? KernelLock::of_another : KernelLock::unsupported;
}

enum class LockState {
  free,        ///< not locked
  left,        ///< of a process of this host that has ended
  held,        ///< of a process that runs
  unseen,      ///< names another host or no process, and the kernel knows of no lock
  in_the_make  ///< without text, and locked
};

LockState state_of(KernelLock kernel, const std::string& text) {
  if (text.empty()) return kernel == KernelLock::taken ? LockState::free : LockState::in_the_make;
  if (kernel == KernelLock::of_another) return LockState::held;
  const std::string holder = holder_in(text), here = on_this_host();
  const bool of_this_host = holder.size() > here.size() && holder.substr(holder.size() - here.size()) == here;
  return kernel == KernelLock::taken && of_this_host ? LockState::left : LockState::unseen;
}

[[noreturn]] void refuse(const fs::path& folder, LockState state, const std::string& text, const std::string& remedy) {
  const std::string file = (folder / lock_name).string(), holder = holder_in(text);
  if (holder.empty())
    throw InputError(folder.string(), "", "is locked, and " + file + " does not say by whom",
                     "if no run works in the folder, remove that file");
  if (state == LockState::unseen)
    throw InputError(folder.string(), "",
                     "is locked by " + holder + "; from here it cannot be seen whether that still runs",
                     "if it does not, remove " + file);
  throw InputError(folder.string(), "", "a run works in it (" + holder + ")", remedy);
}

/// Whether the state of a lock may change in a moment, so that another try makes sense.
bool may_change(LockState state, const std::string& text, int tries) {
  return (state == LockState::held || state == LockState::in_the_make) &&
         tries < (text.empty() ? tries_without_text : tries_with_text);
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
    for (int tries = 0; !take(program, tries); ++tries) ::usleep(pause_microseconds);
  } catch (...) {
    release();
    throw;
  }
}

FolderLock::~FolderLock() {
  release();
}

void FolderLock::close_file() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

/// Opens the lock file. \returns whether it made the file; without a descriptor file or folder was removed in between
bool FolderLock::open_file() {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_EXCL | open_flags, 0666);
  if (descriptor_ >= 0) return true;
  if (errno == EEXIST) descriptor_ = ::open(file_.c_str(), O_RDWR | open_flags);
  if (descriptor_ < 0 && errno != ENOENT) refuse_writing(folder_, errno);
  return false;
}

/// One try. \returns false when another may succeed
bool FolderLock::take(const std::string& program, int tries) {
  const SignalsWait until_it_is_kept_for_removal;
  const auto made = make_folder(folder_);
  if (!made.empty()) made_ = made;  // again, if another run has removed the folder meanwhile
  require_regular_or_absent(file_, false);
  const bool created = open_file();
  if (descriptor_ < 0) return false;
  const KernelLock kernel = try_kernel_lock(descriptor_, LOCK_EX);
  const std::string text = contents_of(descriptor_);
  const LockState state = created && kernel == KernelLock::unsupported ? LockState::free : state_of(kernel, text);
  const bool again = may_change(state, text, tries) || (kernel == KernelLock::taken && !is_ours());
  if (again || (state != LockState::free && state != LockState::left)) {
    close_file();
    if (again) return false;
    refuse(folder_, state, text, "wait for its end, or give -o another folder");
  }
  if (state == LockState::left)
    said_ = folder_.string() + ": took over the lock of " + holder_in(text) + ", which has ended";
  write_holder(program);
  return true;
}

/// Writes which process holds the lock, and registers file and folders for removal by a signal.
void FolderLock::write_holder(const std::string& program) {
  on_signal_.clear();
  for (auto above = made_.rbegin(); above != made_.rend(); ++above) on_signal_.emplace_back(*above);
  on_signal_.emplace_back(file_);
  const std::string text = fmt::format("{}, process {}{}\n", program, getpid(), on_this_host());
  const bool written = ::ftruncate(descriptor_, 0) == 0 &&
                       ::pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
  if (!written) refuse_writing(folder_, errno);
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
  if (is_ours()) ::unlink(file_.c_str());  // before the kernel's lock is released: processes that wait for it try again
  close_file();
  on_signal_.clear();
  for (const auto& made : made_) ::rmdir(made.c_str());  // only empty ones go
  made_.clear();
}

void require_no_run_in(const fs::path& folder, const std::string& remedy) {
  const fs::path file = folder / lock_name;
  for (int tries = 0;; ++tries) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | open_flags);
    if (descriptor < 0) return;  // no lock, or one that cannot be read: writing there would fail as well
    const KernelLock kernel = try_kernel_lock(descriptor, LOCK_SH);
    const std::string text = contents_of(descriptor);
    ::close(descriptor);
    const LockState state = state_of(kernel, text);
    if (state == LockState::free || state == LockState::left) return;
    if (!may_change(state, text, tries)) refuse(folder, state, text, remedy);
    ::usleep(pause_microseconds);
  }
}

}  // namespace fsi
