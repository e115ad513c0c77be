#pragma once

namespace fsi {

/// Threads that element loops use from now on; 0 asks for one per core this process may run on. Returns the number set.
int set_threads(int count);
/// The number last set; one per available core before that.
int threads();

}  // namespace fsi
