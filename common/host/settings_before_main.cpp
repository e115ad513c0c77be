// What the drivers do before the constructors of libraries run: they start themselves again with settings for these.
//
// In main() it is too late where addresses are limited (ulimit -v): the constructor of OpenBLAS has started a thread for
// each core by then, each with 132 MiB of addresses.
#include "host/begin_again.hpp"

namespace {

void begin(int, char** argv, char** environment) {
  fsi::begin_again_with_settings(argv, environment);
}

__attribute__((section(".preinit_array"), used)) void (*const settings_before_libraries)(int, char**, char**) = begin;

}  // namespace
