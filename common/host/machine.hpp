#pragma once

#include <string>

namespace fsi {

/// The model of the first processor in the text of /proc/cpuinfo; on Arm the numbers of implementer and part; "unknown"
/// if it has neither.
std::string processor_in(const std::string& proc_cpuinfo);

/// The model of this machine's processors.
std::string processor();

/// Name and version of the compiler: "gcc 12.2.0", "clang 14.0.6".
std::string compiler();

}  // namespace fsi
