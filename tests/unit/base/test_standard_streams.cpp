#include "host/standard_streams.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "base/error.hpp"

namespace fsi::test {

namespace {

/// What a forked process's check comes to, the standard streams being its own.
template <class Check>
bool in_child(Check check) {
  const pid_t child = fork();
  if (child == 0) _exit(check() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(StandardStreams, ThatAreClosedAreNotGivenToFiles) {
  EXPECT_TRUE(in_child([] {
    for (int descriptor = 0; descriptor < 3; ++descriptor) close(descriptor);
    guard_standard_streams();
    const int file = open("/dev/null", O_WRONLY);
    return file > 2 && write(1, "x", 1) < 0 && write(2, "x", 1) < 0 && nobody_reads(errno);
  }));
}

TEST(StandardStreams, ThatAreOpenStay) {
  EXPECT_TRUE(in_child([] {
    int ends[2];
    if (pipe(ends) != 0 || dup2(ends[1], 1) < 0) return false;
    close(2);
    guard_standard_streams();
    char read_back = 0;
    return write(1, "x", 1) == 1 && read(ends[0], &read_back, 1) == 1 && read_back == 'x';
  }));
}

TEST(StandardStreams, WithoutAReaderAreAnErrorAndNoSignal) {
  EXPECT_TRUE(in_child([] {
    int ends[2];
    if (pipe(ends) != 0 || dup2(ends[1], 1) < 0) return false;
    close(ends[0]);
    guard_standard_streams();
    if (!nobody_reads(try_to_print("text\n"))) return false;
    try {
      print("text\n");
    } catch (const InputError&) {
      return true;
    }
    return false;
  }));
}

TEST(StandardStreams, ThatAreFullAreAnErrorOfAnotherKind) {
  EXPECT_TRUE(in_child([] {
    guard_standard_streams();
    if (dup2(open("/dev/full", O_WRONLY), 1) < 0) return false;
    const int error = try_to_print("text\n");
    return error == ENOSPC && !nobody_reads(error);
  }));
}

}  // namespace

}  // namespace fsi::test
