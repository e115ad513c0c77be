#include "io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

// The file begins with a block that HDF5 skips. It names the format and carries the checksum of all bytes behind it, so
// that damage of any kind is found before the library looks at the file.
constexpr std::size_t block_size = 512;
constexpr const char* signature = "fsi-duo checkpoint 1\nchecksum ";
using Block = std::array<char, block_size>;

Block block_for(const std::string& checksum) {
  Block block{};
  const auto text = signature + checksum + "\n";
  std::memcpy(block.data(), text.data(), text.size());
  return block;
}

std::string checksum_behind_block(std::ifstream& stream) {
  stream.clear();
  stream.seekg(block_size);
  Fnv1a hash;
  std::vector<char> piece(1 << 16);
  while (stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    hash.add(piece.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return hash.hex();
}

void verify(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw InputError(file.string(), "", "no such checkpoint",
                     "give --restart the folder of a run that has written checkpoint.h5");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "", "cannot be read", "check its permissions");
  Block block{};
  stream.read(block.data(), block.size());
  if (std::strncmp(block.data(), signature, std::strlen(signature)) != 0)
    throw InputError(file.string(), "", "is no checkpoint of this program",
                     "give --restart the folder of a run that has written checkpoint.h5");
  if (block != block_for(checksum_behind_block(stream)))
    throw InputError(file.string(), "checksum", "does not match: the file is truncated or damaged",
                     "run from the start, or restart from another folder");
}

/// "does not hold X" for a name that a checkpoint of this program and case should have.
[[noreturn]] void refuse_lacking(const fs::path& file, const std::string& name) {
  throw InputError(file.string(), name, "missing", "the checkpoint comes from another version; run from the start");
}

}  // namespace

fs::path checkpoint_file(const fs::path& folder) {
  return folder / "checkpoint.h5";
}

void write_checkpoint(const fs::path& file, const Checkpoint& checkpoint) {
  std::uint64_t size = 1 << 16;
  for (const auto& entry : checkpoint.arrays) size += sizeof(double) * entry.second.size() + 1024;
  auto hdf5 = Hdf5File::create_in_memory(file, block_size, size);
  hdf5.write_attribute("/", "program", checkpoint.program);
  hdf5.write_attribute("/", "case_hash", checkpoint.case_hash);
  hdf5.write_attribute("/", "mesh_hash", checkpoint.mesh_hash);
  hdf5.write_new<std::int64_t>("/step", {1}, &checkpoint.step);
  hdf5.write_new<double>("/time", {1}, &checkpoint.time);
  for (const auto& [name, values] : checkpoint.arrays) {
    assert(name.find('/') == std::string::npos);
    hdf5.write_new<double>("/arrays/" + name, {values.size()}, values.data());
  }
  for (const auto& [name, value] : checkpoint.integers) hdf5.write_new<std::int64_t>("/integers/" + name, {1}, &value);
  for (const auto& [name, value] : checkpoint.reals) hdf5.write_new<double>("/reals/" + name, {1}, &value);

  std::string bytes(block_size, '\0');
  bytes.reserve(block_size + size);
  hdf5.append_image(bytes);
  hdf5.close();
  Fnv1a hash;
  hash.add(bytes.data() + block_size, bytes.size() - block_size);
  const auto block = block_for(hash.hex());
  std::copy(block.begin(), block.end(), bytes.begin());
  write_atomically(file, bytes, ReadBack::yes);
}

Checkpoint read_checkpoint(const fs::path& file) {
  verify(file);
  const auto hdf5 = Hdf5File::open(file, false);
  Checkpoint checkpoint;
  checkpoint.program = hdf5.read_attribute("/", "program");
  checkpoint.case_hash = hdf5.read_attribute("/", "case_hash");
  checkpoint.mesh_hash = hdf5.read_attribute("/", "mesh_hash");
  checkpoint.step = hdf5.read<std::int64_t>("/step").at(0);
  checkpoint.time = hdf5.read<double>("/time").at(0);
  if (hdf5.has("/arrays"))
    for (const auto& name : hdf5.members("/arrays")) checkpoint.arrays[name] = hdf5.read<double>("/arrays/" + name);
  if (hdf5.has("/integers"))
    for (const auto& name : hdf5.members("/integers"))
      checkpoint.integers[name] = hdf5.read<std::int64_t>("/integers/" + name).at(0);
  if (hdf5.has("/reals"))
    for (const auto& name : hdf5.members("/reals")) checkpoint.reals[name] = hdf5.read<double>("/reals/" + name).at(0);
  return checkpoint;
}

void require_same_run(const fs::path& file, const Checkpoint& checkpoint, const std::string& program,
                      const std::string& case_hash, const std::string& mesh_hash) {
  if (checkpoint.program != program)
    throw InputError(file.string(), "program", "was written by " + checkpoint.program + ", not " + program,
                     "continue it with " + checkpoint.program);
  // The case first: its element and geometry decide what is made of a mesh file.
  if (checkpoint.case_hash != case_hash)
    throw InputError(file.string(), "case",
                     "belongs to another case (hash " + checkpoint.case_hash + ", not " + case_hash + ")",
                     "restart with the case file of that run; only title, time.step, time.end, time.predictor, "
                     "static.load_steps, [monolithic], [partitioned] and [output] may differ");
  if (checkpoint.mesh_hash != mesh_hash)
    throw InputError(file.string(), "mesh",
                     "belongs to another mesh (hash " + checkpoint.mesh_hash + ", not " + mesh_hash + ")",
                     "restart with the mesh of that run");
}

const std::vector<double>& require_size(const fs::path& file, const Checkpoint& checkpoint, const std::string& name,
                                        std::size_t size) {
  const auto found = checkpoint.arrays.find(name);
  if (found == checkpoint.arrays.end()) refuse_lacking(file, name);
  if (found->second.size() != size)
    throw InputError(file.string(), name, fmt::format("has {} values, not {}", found->second.size(), size),
                     "restart with the case and mesh of that run");
  return found->second;
}

std::int64_t require_integer(const fs::path& file, const Checkpoint& checkpoint, const std::string& name) {
  const auto found = checkpoint.integers.find(name);
  if (found == checkpoint.integers.end()) refuse_lacking(file, name);
  return found->second;
}

double require_real(const fs::path& file, const Checkpoint& checkpoint, const std::string& name) {
  const auto found = checkpoint.reals.find(name);
  if (found == checkpoint.reals.end()) refuse_lacking(file, name);
  return found->second;
}

}  // namespace fsi
