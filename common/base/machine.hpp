#pragma once

#include <string>

namespace fsi {

/// The model of the first processor in the text of /proc/cpuinfo; "unknown" where it names none.
std::string processor_in(const std::string& proc_cpuinfo);

/// The model of this machine's processors.
std::string processor();

/// The instruction set that this program is compiled for: "x86-64-v4", "x86-64-v3", "x86-64-v2", "x86-64", as -march
/// names levels, the highest that holds; "aarch64" or "other" elsewhere.
std::string instruction_set();

/// Name and version of the compiler: "gcc 12.2.0", "clang 14.0.6".
std::string compiler();

}  // namespace fsi
