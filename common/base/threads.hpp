#pragma once

namespace fsi {

/// Threads that element loops use from now on; 0 asks for one per core this process may run on. Returns the number set.
int set_threads(int count);
/// The number last set; one per available core before that.
int threads();

/// Lets waiting threads sleep instead of spin. On a core that another job wants, a spinning thread uses up the time
/// that the others wait for: a run with two threads took ten times as long as with one. The runtime of OpenMP reads
/// this from the environment before main() begins, so the program starts itself again; to be called first in main().
/// Does nothing where OMP_WAIT_POLICY or GOMP_SPINCOUNT is set. \param argv  as main() has it, ended by a null pointer
void sleep_while_waiting(const char* const* argv);

}  // namespace fsi
