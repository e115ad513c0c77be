/* Preloaded: allocations that fail on purpose, in whatever library or thread they are made.

   MEMORY_FAULT   once:N    the N-th allocation fails
                  from:N    the N-th and all later ones
                  above:K   every one of K bytes or more
                  random:P  one in P, by MEMORY_SEED
   MEMORY_COUNT   a file that the number of allocations is written to at the end

   Allocations are malloc, calloc, realloc, posix_memalign, aligned_alloc, memalign and anonymous mmap. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

enum Kind { unknown, none, once, from, above, random_ones };

static atomic_int kind = unknown;
static unsigned long long number, seed;
static atomic_ullong calls;

static enum Kind read_kind(void) {
  enum Kind found = none;
  const char* fault = getenv("MEMORY_FAULT");
  if (fault != NULL) {
    const char* colon = strchr(fault, ':');
    number = colon != NULL ? strtoull(colon + 1, NULL, 10) : 0;
    if (strncmp(fault, "once:", 5) == 0) found = once;
    if (strncmp(fault, "from:", 5) == 0) found = from;
    if (strncmp(fault, "above:", 6) == 0) found = above;
    if (strncmp(fault, "random:", 7) == 0) found = random_ones;
  }
  const char* text = getenv("MEMORY_SEED");
  seed = text != NULL ? strtoull(text, NULL, 10) : 1;
  return found;
}

/* Of the number of the call alone, so that a run can be made again. */
static unsigned long long mixed(unsigned long long x) {
  x += 0x9e3779b97f4a7c15ull * (seed + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

static int fails(size_t size) {
  extern char** environ;
  if (environ == NULL || size == 0) return 0; /* before the C library is ready */
  int now = atomic_load(&kind);
  if (now == unknown) atomic_store(&kind, now = read_kind());
  const unsigned long long call = atomic_fetch_add(&calls, 1) + 1;
  const int yes = (now == once && call == number) || (now == from && call >= number) ||
                  (now == above && size >= number) || (now == random_ones && number > 0 && mixed(call) % number == 0);
  if (yes) errno = ENOMEM;
  return yes;
}

void* malloc(size_t size) {
  return fails(size) ? NULL : __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  return fails(count != 0 && size > SIZE_MAX / count ? SIZE_MAX : count * size) ? NULL : __libc_calloc(count, size);
}

void* realloc(void* old, size_t size) {
  return fails(size) ? NULL : __libc_realloc(old, size);
}

void* memalign(size_t alignment, size_t size) {
  return fails(size) ? NULL : __libc_memalign(alignment, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
  return memalign(alignment, size);
}

int posix_memalign(void** memory, size_t alignment, size_t size) {
  void* got = memalign(alignment, size);
  if (got == NULL && size > 0) return ENOMEM;
  *memory = got;
  return 0;
}

void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset) {
  static void* (*next)(void*, size_t, int, int, int, off_t);
  if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, "mmap");
  if ((flags & MAP_ANONYMOUS) != 0 && fails(size)) return MAP_FAILED;
  return next(address, size, protection, flags, file, offset);
}

__attribute__((destructor)) static void report(void) {
  const char* file = getenv("MEMORY_COUNT");
  if (file == NULL) return;
  char text[32];
  const int length = snprintf(text, sizeof text, "%llu\n", (unsigned long long)atomic_load(&calls));
  const int descriptor = open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return;
  if (write(descriptor, text, (size_t)length) != length) unlink(file);
  close(descriptor);
}
