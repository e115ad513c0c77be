#pragma once

#include <filesystem>
#include <string>

#include "host/removed_on_signal.hpp"

namespace fsi {

/// A .msh file beside the one that it is to become, or to help make; removed again unless it was moved to its name.
class TemporaryMesh {
 public:
  /// \param purpose  part of its name; two of one process that live at the same time need different ones
  explicit TemporaryMesh(const std::filesystem::path& final_name, const std::string& purpose = "");
  ~TemporaryMesh();
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// On disk first: whatever happens, the name stands for the old file or for the whole new one.
  /// \throws InputError when the file system refuses
  void move_into_place() const;

 private:
  std::filesystem::path final_name_, path_;
  RemovedOnSignal on_signal_;
};

}  // namespace fsi
