#pragma once

namespace fsi {

/// Starts a driver again with variables that libraries read from the environment before main() begins
/// (docs/guide/running.md#threads). Those that are set already stay; returns if all are, or if it cannot be started.
/// - GOMP_SPINCOUNT: waiting threads spin for a microsecond or so only, then sleep. On a core that another job wants, a
///   thread that spins on uses up the time that the others wait for; one that sleeps at once is late where nobody wants
///   its core. Not if OMP_WAIT_POLICY is set.
/// - OPENBLAS_NUM_THREADS: 1. OpenBLAS would start a thread per core at once, each with 132 MiB of addresses, which
///   most runs never use. DirectSolver starts those it needs.
/// - OPENBLAS_CORETYPE: kernels for the vectors that the processor has. OpenBLAS goes by a list of models. For a model
///   newer than the list it takes kernels of twenty years ago, which multiply matrices at a quarter of the speed.
/// - GLIBC_TUNABLES: memory in pages of 2 MiB where the kernel offers them on request, and a heap that keeps what is
///   freed at its end. With pages of 4 KiB a run of 100,000 unknowns touches 80,000 of them, and products with sparse
///   matrices wait for page tables.
///
/// None of these can be set later: OpenMP and OpenBLAS have no functions for the first and third, glibc none for large
/// pages, and no allocator sets the first three (docs/archive.md). fsi-mesh needs none of them.
///
/// Allocates nothing, so that it can be called before libraries are ready.
/// \param argv         as main() has it, ended by a null pointer
/// \param environment  likewise
void begin_again_with_settings(const char* const* argv, char* const* environment) noexcept;

}  // namespace fsi
