#pragma once

namespace fsi {

/// Begins the HDF5 library so that it does no work when the program ends, where it would write to files that could not be
/// written before, and crash. To be called before MPI begins, too: the library, if it begins later, has MPI's end do that
/// work.
void begin_hdf5();

}  // namespace fsi
