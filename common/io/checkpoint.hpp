#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "parallel/whole_order.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

class Hdf5File;

/// All that a run needs to continue as if it had not stopped.
struct Checkpoint {
  std::string program;    ///< "fsi-monolithic" or "fsi-partitioned"
  std::string case_hash;  ///< hash_of_case
  std::string case_text;  ///< readable_dump, to say what differs; may be empty
  std::string mesh_hash;  ///< hash_of_mesh
  std::int64_t step = 0;  ///< the last finished step
  double time = 0;        ///< ms
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, ArrayKind> kinds;  ///< of the arrays of a run; files do not keep them
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, double> reals;
};

/// DIR/checkpoint.h5
std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// Makes the file in memory with its checksum, writes it under a temporary name, puts it on disk, reads it back, and
/// renames it only if it holds the same bytes: a kill or a full disk leaves the previous checkpoint.
/// \throws WriteError when the file cannot be written
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// \throws InputError when the file is missing, no checkpoint, in another version's format or damaged (checksum)
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// How processes share out an array of a checkpoint: each holds the numbers of its items. In the file the array is in
/// the whole order, as one process writes it. An array may be empty, at all processes.
struct SharedArray {
  const WholeOrder* order;
  int entries;           ///< numbers per item
  bool columns = false;  ///< any number of such arrays, one after the other
};
/// How the array of a name is shared out; empty: all processes have the same.
using ArraySharing = std::function<std::optional<SharedArray>(const std::string& name)>;

/// The same for all processes together, each with its part of the arrays; they write a temporary file in place of
/// memory. The file holds what one process would write, and any number of processes can read it.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint, const Communicator& processes,
                      const ArraySharing& sharing);

/// A checkpoint whose arrays are read one by one, once it is known how they are shared out. For all processes together.
class CheckpointReader {
 public:
  /// \throws InputError as read_checkpoint()
  CheckpointReader(std::filesystem::path file, const Communicator& processes);
  ~CheckpointReader();

  /// Everything but the arrays.
  const Checkpoint& head() const { return head_; }
  /// Names of the arrays.
  const std::vector<std::string>& arrays() const { return arrays_; }
  /// The part here of an array that is shared out, else all of it.
  /// \throws InputError also when a shared array does not have the size of the whole order, at all processes
  std::vector<double> array(const std::string& name, const std::optional<SharedArray>& how) const;

 private:
  std::filesystem::path file_;
  const Communicator& processes_;
  std::unique_ptr<const Hdf5File> hdf5_;
  Checkpoint head_;
  std::vector<std::string> arrays_;
};

/// All of a checkpoint. \throws InputError as CheckpointReader
Checkpoint read_checkpoint(const std::filesystem::path& file, const Communicator& processes,
                           const ArraySharing& sharing);

/// Refuses a checkpoint of another program, case or mesh; `file` names it in the message.
/// \param difference  of the cases, as difference_of_cases() tells it, if they differ \throws InputError
void require_same_run(const std::filesystem::path& file, const Checkpoint& checkpoint, const std::string& program,
                      const std::string& case_hash, const std::string& mesh_hash, const std::string& difference = "");

/// The array `name`, which must have `size` entries. \throws InputError
const std::vector<double>& require_size(const std::filesystem::path& file, const Checkpoint& checkpoint,
                                        const std::string& name, std::size_t size);

}  // namespace fsi
