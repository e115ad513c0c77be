#pragma once

namespace fsi {

/// Starts the HDF5 library so that it does nothing when the program ends: it would write again to files that could not
/// be written, and crash. Also to be called before MPI starts: a library that starts later does that work in
/// MPI_Finalize.
void begin_hdf5();

}  // namespace fsi
