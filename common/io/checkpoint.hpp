#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fsi {

/// All that a run needs to go on as if it had not stopped.
struct Checkpoint {
  std::string program;    ///< "fsi-monolithic" or "fsi-partitioned"
  std::string case_hash;  ///< hash_of_case
  std::string mesh_hash;  ///< hash_of_file
  std::int64_t step = 0;  ///< the last finished step
  double time = 0;        ///< ms
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, double> reals;
};

/// DIR/checkpoint.h5
std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// Makes the file in memory, where its checksum is taken, writes it under a temporary name, puts it on disk, reads it
/// back, and renames it only if it holds the same bytes: a kill or a full disk leaves the previous checkpoint.
/// \throws WriteError when the file cannot be written
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// \throws InputError when the file is missing, no checkpoint, truncated, or its checksum does not match
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Refuses a checkpoint of another program, case or mesh; `file` names it in the message. \throws InputError
void require_same_run(const std::filesystem::path& file, const Checkpoint& checkpoint, const std::string& program,
                      const std::string& case_hash, const std::string& mesh_hash);

/// The array `name`, which must have `size` entries. \throws InputError
const std::vector<double>& require_size(const std::filesystem::path& file, const Checkpoint& checkpoint,
                                        const std::string& name, std::size_t size);
/// \throws InputError when the checkpoint does not hold it
std::int64_t require_integer(const std::filesystem::path& file, const Checkpoint& checkpoint, const std::string& name);
double require_real(const std::filesystem::path& file, const Checkpoint& checkpoint, const std::string& name);

}  // namespace fsi
