#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/hdf5_file.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// Fills datasets of an HDF5 file that is there already, each process its stretches of them, collectively. Nothing but
/// their numbers is written. All processes make it, and call the same functions in the same order.
class StretchWriter {
 public:
  /// \param shown_as  name in messages
  StretchWriter(const std::filesystem::path& file, std::filesystem::path shown_as, const Communicator& processes);

  /// \param first   of the dataset's numbers, row after row, the one that this process's begin with
  /// \param values  of this process, perhaps none
  template <class Value>
  void write(const std::string& dataset, std::uint64_t first, const std::vector<Value>& values) {
    if (!file_.write_part(dataset, first, values.size(), values.data())) note_failure(dataset);
  }

  /// Onto the disk, and closes. \throws WriteError at processes where something could not be written, at others nothing
  void close();

 private:
  void note_failure(const std::string& dataset);

  const Communicator& processes_;
  std::filesystem::path shown_as_;
  Hdf5File file_;
  bool failed_ = false;
  int error_ = 0;  ///< errno of the first failure
  std::string dataset_;
};

}  // namespace fsi
