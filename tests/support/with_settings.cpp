// with_settings COMMAND...: runs a command with the environment in which programs start themselves again
// (host/begin_again.hpp). Tests start them by the thousand: each then starts once, not twice. What the environment has
// already stays as it is, as with the programs.

#include <unistd.h>

#include <cstdio>

#include "host/threads.hpp"

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  fsi::wait_briefly(argv);
  execvp(argv[1], argv + 1);
  std::perror(argv[1]);
  return 127;
}
