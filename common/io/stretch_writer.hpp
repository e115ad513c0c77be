#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/hdf5_file.hpp"
#include "parallel/communicator.hpp"

namespace fsi {

/// Writes values into existing datasets of an HDF5 file, each process its stretches, collectively; nothing else in the
/// file changes. All processes construct it and call the same functions in the same order.
class StretchWriter {
 public:
  /// \param shown_as  name in messages \throws WriteError when the file cannot be opened
  StretchWriter(const std::filesystem::path& file, std::filesystem::path shown_as, const Communicator& processes);

  /// \param first   index of this process's first number in the dataset, row after row
  /// \param values  of this process, perhaps none
  template <class Value>
  void write(const std::string& dataset, std::uint64_t first, const std::vector<Value>& values) {
    if (!file_.write_part(dataset, first, values.size(), values.data())) note_failure(dataset);
  }

  /// Puts the file on disk and closes it. \throws WriteError only at processes where something could not be written
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
