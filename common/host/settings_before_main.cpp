// Starts the drivers again with settings for libraries, before the constructors of these run.
//
// In main() it is too late if addresses are limited (ulimit -v): by then the constructor of OpenBLAS has started a
// thread for each core, each with 132 MiB of addresses.
#include "host/begin_again.hpp"

namespace {

void begin(int, char** argv, char** environment) {
  fsi::begin_again_with_settings(argv, environment);
}

__attribute__((section(".preinit_array"), used)) void (*const settings_before_libraries)(int, char**, char**) = begin;

}  // namespace
