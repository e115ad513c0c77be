#pragma once

#include <string>

namespace fsi {

// The one place that distinguishes kinds of processors: widths of vectors and names of instruction sets.

/// Doubles in a vector of the instruction set that is compiled for.
#if defined(__AVX512F__)
inline constexpr int vector_doubles = 8;
#elif defined(__AVX__)
inline constexpr int vector_doubles = 4;
#else
inline constexpr int vector_doubles = 2;  // SSE2, NEON
#endif

/// The instruction set that this program is compiled for: the highest level that holds, as -march names it
/// ("x86-64-v4", "x86-64-v3", "x86-64-v2", "x86-64"); "aarch64" or "other" elsewhere.
std::string instruction_set();

/// Value of OPENBLAS_CORETYPE whose kernels use the widest vectors of this processor; null: OpenBLAS chooses by itself.
const char* dense_kernel_processor() noexcept;

}  // namespace fsi
