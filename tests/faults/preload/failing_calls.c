// Preloaded into a program (LD_PRELOAD), counts the calls that change files beneath a folder, and makes chosen ones fail.
// Everything else passes through. Settings are environment variables:
//
//   FSI_FAULT_FOLDER   absolute path; calls on files beneath it, and on the folder itself, count
//   FSI_FAULT_LOG      file that gets a line "NUMBER KIND BYTES NAME" per call
//   FSI_FAULT_AT       number of the call to disturb, from 1; 0: none
//   FSI_FAULT_ERRNO    errno of a call that fails
//   FSI_FAULT_LASTING  1: all later calls fail too
//   FSI_FAULT_SHORT    1: a write takes half of its bytes and says so, other calls pass
//   FSI_FAULT_DELETED  name of a file in the folder that is deleted before the call, which passes; so do later ones
//   FSI_FAULT_EMPTIED  the same, but its contents go and the file stays
//   FSI_FAULT_BUDGET   bytes that the disk takes: a write beyond them is cut, the next one fails with ENOSPC
//
// A close that fails has closed, as on Linux. A rename or an fsync that fails has done nothing.

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum { descriptors = 4096 };

static char* names[descriptors];  // of the watched files that are open; NULL: not watched
static const char* folder;
static size_t folder_length;
static int log_descriptor = -1;
static long fault_at, fault_errno, budget = -1;
static int lasting, cut_short;
static atomic_long calls;

static long setting(const char* name, long otherwise) {
  const char* text = getenv(name);
  return text && *text ? atol(text) : otherwise;
}

__attribute__((constructor)) static void read_settings(void) {
  fault_at = setting("FSI_FAULT_AT", 0);
  fault_errno = setting("FSI_FAULT_ERRNO", ENOSPC);
  lasting = setting("FSI_FAULT_LASTING", 0) != 0;
  cut_short = setting("FSI_FAULT_SHORT", 0) != 0;
  budget = setting("FSI_FAULT_BUDGET", -1);
  const char* log = getenv("FSI_FAULT_LOG");
  if (log && *log) {
    const int low = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    log_descriptor = fcntl(low, F_DUPFD_CLOEXEC, 1000);  // out of the program's way
    syscall(SYS_close, low);
  }
  folder = getenv("FSI_FAULT_FOLDER");
  if (folder) folder_length = strlen(folder);
}

static int beneath(const char* path) {
  return folder && path && strncmp(path, folder, folder_length) == 0 &&
         (path[folder_length] == '/' || path[folder_length] == '\0');
}

static const char* name_of(int descriptor) {
  return descriptor >= 0 && descriptor < descriptors ? names[descriptor] : NULL;
}

static void watch(int descriptor, const char* path) {
  if (descriptor < 0 || descriptor >= descriptors) return;
  free(names[descriptor]);
  names[descriptor] = beneath(path) ? strdup(path) : NULL;
}

/// Deletes or empties a file, if that is the disturbance that is asked for.
static int has_harmed_a_file(void) {
  const char *deleted = getenv("FSI_FAULT_DELETED"), *emptied = getenv("FSI_FAULT_EMPTIED");
  if (!deleted && !emptied) return 0;
  char path[PATH_MAX];
  snprintf(path, sizeof path, "%s/%s", folder, deleted ? deleted : emptied);
  if (deleted)
    syscall(SYS_unlinkat, AT_FDCWD, path, 0);
  else
    syscall(SYS_truncate, path, 0L);
  return 1;
}

/// Counts a call; whether it is to be disturbed.
static int disturbed(const char* kind, size_t bytes, const char* name) {
  const long number = atomic_fetch_add(&calls, 1) + 1;
  if (log_descriptor >= 0) {
    char line[PATH_MAX + 64];
    const int length = snprintf(line, sizeof line, "%ld %s %zu %s\n", number, kind, bytes, name);
    if (length > 0) syscall(SYS_write, log_descriptor, line, (size_t)length);
  }
  const int chosen = fault_at > 0 && (number == fault_at || (lasting && number > fault_at));
  return chosen && !has_harmed_a_file();
}

/// The same for calls that take or move no bytes: whether it is to fail.
static int fails(const char* kind, const char* name) {
  if (!disturbed(kind, 0, name) || cut_short) return 0;
  errno = (int)fault_errno;
  return 1;
}

/// How many of `size` bytes a write is to take: -1 none, with errno.
static ssize_t share(const char* kind, size_t size, const char* name) {
  if (disturbed(kind, size, name)) {
    if (cut_short && size > 1) return (ssize_t)(size / 2);
    if (!cut_short) {
      errno = (int)fault_errno;
      return -1;
    }
  }
  if (budget < 0 || size == 0) return (ssize_t)size;
  if (budget == 0) {
    errno = ENOSPC;
    return -1;
  }
  if ((long)size > budget) size = (size_t)budget;
  budget -= (long)size;
  return (ssize_t)size;
}

// --- open

static int open_watched(int at, const char* path, int flags, mode_t mode) {
  const int for_writing = (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT);
  if (beneath(path) && for_writing && fails("open", path)) return -1;
  const int descriptor = (int)syscall(SYS_openat, at, path, flags, mode);
  watch(descriptor, path);
  return descriptor;
}

static mode_t mode_argument(int flags, va_list arguments) {
  return flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
}

#define OPEN(NAME)                                       \
  int NAME(const char* path, int flags, ...) {           \
    va_list arguments;                                   \
    va_start(arguments, flags);                          \
    const mode_t mode = mode_argument(flags, arguments); \
    va_end(arguments);                                   \
    return open_watched(AT_FDCWD, path, flags, mode);    \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(NAME)                                     \
  int NAME(int at, const char* path, int flags, ...) {   \
    va_list arguments;                                   \
    va_start(arguments, flags);                          \
    const mode_t mode = mode_argument(flags, arguments); \
    va_end(arguments);                                   \
    return open_watched(at, path, flags, mode);          \
  }
OPENAT(openat)
OPENAT(openat64)

int creat(const char* path, mode_t mode) {
  return open_watched(AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, mode);
}
int creat64(const char* path, mode_t mode) {
  return creat(path, mode);
}

// What the C library's headers make of open with two arguments.
int __open_2(const char* path, int flags) {
  return open_watched(AT_FDCWD, path, flags, 0);
}
int __open64_2(const char* path, int flags) {
  return open_watched(AT_FDCWD, path, flags, 0);
}

// The C++ library opens its streams by fopen and writes to their descriptors by write, which is seen below.
static FILE* fopen_watched(const char* real, const char* path, const char* mode) {
  FILE* (*next)(const char*, const char*) = (FILE * (*)(const char*, const char*)) dlsym(RTLD_NEXT, real);
  const int for_writing = strpbrk(mode, "wa+") != NULL;
  if (beneath(path) && for_writing && fails("open", path)) return NULL;
  FILE* stream = next(path, mode);
  if (stream) watch(fileno(stream), path);
  return stream;
}
FILE* fopen(const char* path, const char* mode) {
  return fopen_watched("fopen", path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  return fopen_watched("fopen64", path, mode);
}

// --- write

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const char* name = name_of(descriptor);
  const ssize_t taken = name ? share("write", size, name) : (ssize_t)size;
  return taken < 0 ? -1 : syscall(SYS_write, descriptor, bytes, (size_t)taken);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  const char* name = name_of(descriptor);
  const ssize_t taken = name ? share("pwrite", size, name) : (ssize_t)size;
  return taken < 0 ? -1 : syscall(SYS_pwrite64, descriptor, bytes, (size_t)taken, offset);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  return pwrite64(descriptor, bytes, size, offset);
}

// A gathered write that is cut takes its first piece only, or less.
ssize_t writev(int descriptor, const struct iovec* pieces, int count) {
  const char* name = name_of(descriptor);
  size_t size = 0;
  for (int i = 0; i < count; ++i) size += pieces[i].iov_len;
  const ssize_t taken = name ? share("writev", size, name) : (ssize_t)size;
  if (taken < 0) return -1;
  if ((size_t)taken == size) return syscall(SYS_writev, descriptor, pieces, count);
  const size_t first = pieces[0].iov_len;
  return syscall(SYS_write, descriptor, pieces[0].iov_base, (size_t)taken < first ? (size_t)taken : first);
}

int ftruncate64(int descriptor, off64_t size) {
  const char* name = name_of(descriptor);
  return name && fails("ftruncate", name) ? -1 : (int)syscall(SYS_ftruncate, descriptor, size);
}
int ftruncate(int descriptor, off_t size) {
  return ftruncate64(descriptor, size);
}

// --- fsync, close, rename

int fsync(int descriptor) {
  const char* name = name_of(descriptor);
  return name && fails("fsync", name) ? -1 : (int)syscall(SYS_fsync, descriptor);
}
int fdatasync(int descriptor) {
  const char* name = name_of(descriptor);
  return name && fails("fdatasync", name) ? -1 : (int)syscall(SYS_fdatasync, descriptor);
}

int close(int descriptor) {
  const char* name = name_of(descriptor);
  const int failed = name && fails("close", name);
  const int number = errno;
  if (name) watch(descriptor, NULL);
  const int result = (int)syscall(SYS_close, descriptor);
  if (!failed) return result;
  errno = number;
  return -1;
}

int fclose(FILE* stream) {
  int (*next)(FILE*) = (int (*)(FILE*))dlsym(RTLD_NEXT, "fclose");
  const int descriptor = fileno(stream);
  const char* name = name_of(descriptor);
  const int failed = name && fails("close", name);
  const int number = errno;
  if (name) watch(descriptor, NULL);
  const int result = next(stream);
  if (!failed) return result;
  errno = number;
  return EOF;
}

int rename(const char* from, const char* to) {
  return beneath(to) && fails("rename", to) ? -1 : (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return beneath(to) && fails("rename", to) ? -1 : (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, 0);
}
