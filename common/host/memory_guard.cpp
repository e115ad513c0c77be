// Allocations and threads of a whole program, its libraries included: one that fails ends the program with one message.
//
// Libraries do not survive a failing allocation: OpenBLAS tries again for ever, METIS and the runtime of OpenMP print
// something of their own and end the process or abort it, constructors of others crash before main() begins. And a C++
// exception in a parallel region or a destructor ends in std::terminate. So the programs define the functions of the C
// library that allocate and that start a thread. The dynamic linker finds a program's functions before those of all
// libraries. They call the next ones in its order.
//
// Callers that handle a failure say so by MayFail (host/available_memory.hpp).
#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "host/available_memory.hpp"

namespace {

/// The function of this name that the linker finds behind the program's own.
template <class Function>
Function* next(const char* name) noexcept {
  auto* found = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  if (found == nullptr) std::abort();
  return found;
}

// From this size on a request is compared with what is available: the system grants memory that it does not have, and
// kills the process when it uses it.
constexpr std::size_t large = std::size_t{256} << 20;

bool beyond_available(std::size_t asked) noexcept {
  return asked >= large && asked > fsi::available_memory().bytes;
}

void* refused(std::size_t asked) noexcept {
  if (!fsi::MayFail::now()) fsi::end_out_of_memory(asked);
  errno = ENOMEM;
  return nullptr;
}

void* checked(void* memory, std::size_t asked) noexcept {
  return memory == nullptr && asked > 0 ? refused(asked) : memory;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  static auto* const allocate = next<void*(std::size_t)>("malloc");
  return beyond_available(size) ? refused(size) : checked(allocate(size), size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  static auto* const allocate = next<void*(std::size_t, std::size_t)>("calloc");
  std::size_t all = 0;
  if (__builtin_mul_overflow(count, size, &all)) all = SIZE_MAX;
  return beyond_available(all) ? refused(all) : checked(allocate(count, size), all);
}

void* realloc(void* old, std::size_t size) noexcept {
  static auto* const allocate = next<void*(void*, std::size_t)>("realloc");
  const std::size_t held = size >= large && old != nullptr ? malloc_usable_size(old) : 0;
  return size > held && beyond_available(size - held) ? refused(size) : checked(allocate(old, size), size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  static auto* const allocate = next<int(void**, std::size_t, std::size_t)>("posix_memalign");
  const int status = beyond_available(size) ? ENOMEM : allocate(memory, alignment, size);
  if (status == ENOMEM) refused(size);
  return status;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  static auto* const allocate = next<void*(std::size_t, std::size_t)>("aligned_alloc");
  return beyond_available(size) ? refused(size) : checked(allocate(alignment, size), size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  static auto* const allocate = next<void*(std::size_t, std::size_t)>("memalign");
  return beyond_available(size) ? refused(size) : checked(allocate(alignment, size), size);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*), void* argument) noexcept {
  using Start = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static auto* const start = next<Start>("pthread_create");
  const int status = start(thread, attributes, body, argument);
  if (status == EAGAIN || status == ENOMEM) fsi::end_without_thread();
  return status;
}

}  // extern "C"

namespace {

/// Bytes available below which a fault is put down to memory.
constexpr std::uint64_t next_to_nothing = std::uint64_t{1} << 20;

/// A fault when no memory is left means that a stack could not grow. Any other takes its default action.
void fault(int signal) {
  if (fsi::available_memory().bytes < next_to_nothing) fsi::end_out_of_memory(0);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// Runs before the constructors of libraries, which allocate as well.
void prepare(int, char**, char**) {
  static char stack[1 << 16];
  stack_t other{};
  other.ss_sp = stack;
  other.ss_size = sizeof stack;
  struct sigaction action {};
  action.sa_handler = fault;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  sigemptyset(&action.sa_mask);
  if (sigaltstack(&other, nullptr) != 0) return;
  sigaction(SIGSEGV, &action, nullptr);
  sigaction(SIGBUS, &action, nullptr);
}

__attribute__((section(".preinit_array"), used)) void (*const before_libraries)(int, char**, char**) = prepare;

}  // namespace
