#pragma once

namespace fsi {

/// Threads that element loops use from now on; 0 asks for one per core this process may run on. Returns the number set.
int set_threads(int count);
/// The number last set; one per available core before that.
int threads();

/// Lets waiting threads spin for a microsecond or so only, then sleep. On a core that another job wants, a thread that
/// spins on uses up the time that the others wait for; one that sleeps at once is late where nobody wants its core
/// (docs/guide/solvers.md#speed). The runtime of OpenMP reads this from the environment before main() begins, so the program
/// starts itself again; to be called first in main(). Does nothing where OMP_WAIT_POLICY or GOMP_SPINCOUNT is set.
/// \param argv  as main() has it, ended by a null pointer
void wait_briefly(const char* const* argv);

}  // namespace fsi
