#pragma once

#include <string>

namespace fsi {

// All that the programs know of kinds of processors stands in this file and its source: the widths of vectors and the names of
// instruction sets. Elsewhere they are the same for each.

/// Doubles that one vector instruction of the set that is compiled for handles.
#if defined(__AVX512F__)
inline constexpr int vector_doubles = 8;
#elif defined(__AVX__)
inline constexpr int vector_doubles = 4;
#else
inline constexpr int vector_doubles = 2;  // SSE2, NEON
#endif

/// The instruction set that this program is compiled for: "x86-64-v4", "x86-64-v3", "x86-64-v2", "x86-64", as -march
/// names levels, the highest that holds; "aarch64" or "other" elsewhere.
std::string instruction_set();

/// The processor that OpenBLAS takes its kernels of, by the widest vectors that this one has, for its variable
/// OPENBLAS_CORETYPE; null: OpenBLAS chooses as it does without.
const char* dense_kernel_processor() noexcept;

}  // namespace fsi
