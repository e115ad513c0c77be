#include "io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "io/atomic_file.hpp"
#include "io/file_in_place.hpp"
#include "io/first_process.hpp"
#include "io/hdf5_file.hpp"
#include "io/stretch_writer.hpp"
#include "io/write_error.hpp"

namespace fsi {

namespace fs = std::filesystem;

namespace {

// The file begins with a block that HDF5 skips. It names the format and has the checksum of all bytes behind it, so
// that any damage is found before the library reads the file.
constexpr std::size_t block_size = 512;
constexpr const char* name_of_format = "fsi-duo checkpoint ";
constexpr const char* signature = "fsi-duo checkpoint 2\nchecksum ";
constexpr std::size_t longest_text = 60000;  // of an attribute, which HDF5 limits
constexpr const char* arrays_group = "/arrays/";
constexpr const char* another_mesh = "restart with the case and mesh of that run";
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
  if (std::strncmp(block.data(), signature, std::strlen(signature)) != 0 &&
      std::strncmp(block.data(), name_of_format, std::strlen(name_of_format)) == 0)
    throw InputError(file.string(), "", "is a checkpoint of another version of this program",
                     "continue with the version that wrote it, or run from the start");
  if (std::strncmp(block.data(), signature, std::strlen(signature)) != 0)
    throw InputError(file.string(), "", "is no checkpoint of this program",
                     "give --restart the folder of a run that has written checkpoint.h5");
  if (block != block_for(checksum_behind_block(stream)))
    throw InputError(file.string(), "checksum", "does not match: the file is truncated or damaged",
                     "run from the start, or restart from another folder");
}

/// Refuses a file without an array that a checkpoint of this program and case should have.
[[noreturn]] void refuse_lacking(const fs::path& file, const std::string& name) {
  throw InputError(file.string(), name, "missing", "the checkpoint comes from another version; run from the start");
}

template <class Value>
Value single(const fs::path& file, const Hdf5File& hdf5, const std::string& dataset) {
  const auto values = hdf5.read<Value>(dataset);
  if (values.size() != 1)
    throw InputError(file.string(), dataset, "holds " + std::to_string(values.size()) + " values, not one",
                     "run from the start, or restart from another folder");
  return values[0];
}

/// An array that is shared out, as its file has it.
struct SharedStretch {
  std::uint64_t whole = 0;  ///< numbers of a column, of all processes
  std::uint64_t first = 0;  ///< the first of them that is this process's
  std::vector<std::vector<double>> columns;
};
using SharedValues = std::map<std::string, SharedStretch>;

/// The stretches that this process writes.
SharedValues shared_values(const Checkpoint& checkpoint, const Communicator& processes, const ArraySharing& sharing) {
  std::vector<std::pair<std::string, SharedArray>> found;
  std::vector<std::int64_t> columns;  // of each, as far as it can be seen here
  for (const auto& [name, values] : checkpoint.arrays)
    if (const auto how = sharing(name)) {
      const std::size_t size = how->order->items() * static_cast<std::size_t>(how->entries);
      assert(size == 0 ? values.empty() : values.size() % size == 0);
      found.emplace_back(name, *how);
      columns.push_back(size == 0 ? 0 : static_cast<std::int64_t>(values.size() / size));
    }
  const auto all = processes.gather(columns);
  SharedValues shared;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [name, how] = found[i];
    std::int64_t most = 0;
    for (std::size_t at = i; at < all.size(); at += found.size()) most = std::max(most, all[at]);
    assert(most <= 1 || how.columns);
    SharedStretch& stretch = shared[name];
    stretch.whole = static_cast<std::uint64_t>(how.order->whole() * how.entries);
    stretch.first = static_cast<std::uint64_t>(how.order->first() * how.entries);
    const auto& values = checkpoint.arrays.at(name);
    for (std::int64_t column = 0; column < most; ++column)
      stretch.columns.push_back(how.order->to_stretches(
          values.data() + static_cast<std::size_t>(column) * how.order->items() * static_cast<std::size_t>(how.entries),
          how.entries));
  }
  return shared;
}

/// Writes everything but the arrays that processes write together, for which it reserves room.
void write_contents(Hdf5File& hdf5, const Checkpoint& checkpoint, const SharedValues& shared) {
  hdf5.write_attribute("/", "program", checkpoint.program);
  hdf5.write_attribute("/", "case_hash", checkpoint.case_hash);
  hdf5.write_attribute("/", "case", checkpoint.case_text.size() <= longest_text ? checkpoint.case_text : "");
  hdf5.write_attribute("/", "mesh_hash", checkpoint.mesh_hash);
  hdf5.write_new<std::int64_t>("/step", {1}, &checkpoint.step);
  hdf5.write_new<double>("/time", {1}, &checkpoint.time);
  for (const auto& [name, values] : checkpoint.arrays) {
    assert(name.find('/') == std::string::npos);
    if (const auto found = shared.find(name); found != shared.end())
      hdf5.create_dataset<double>(arrays_group + name, {found->second.whole * found->second.columns.size()});
    else
      hdf5.write_new<double>(arrays_group + name, {values.size()}, values.data());
  }
  for (const auto& [name, value] : checkpoint.integers) hdf5.write_new<std::int64_t>("/integers/" + name, {1}, &value);
  for (const auto& [name, value] : checkpoint.reals) hdf5.write_new<double>("/reals/" + name, {1}, &value);
}

/// Writes the arrays that are shared out, and reads this process's stretches back. For all processes together.
void write_stretches(const fs::path& temporary, const fs::path& file, const SharedValues& shared,
                     const Communicator& processes) {
  StretchWriter writer(temporary, file, processes);
  for (const auto& [name, stretch] : shared)
    for (std::size_t column = 0; column < stretch.columns.size(); ++column)
      writer.write(arrays_group + name, column * stretch.whole + stretch.first, stretch.columns[column]);
  writer.close();
  const auto again = Hdf5File::open(temporary, false);
  for (const auto& [name, stretch] : shared)
    for (std::size_t column = 0; column < stretch.columns.size(); ++column) {
      const auto& values = stretch.columns[column];
      const auto read =
          again.read_part<double>(arrays_group + name, column * stretch.whole + stretch.first, values.size());
      if (!values.empty() && std::memcmp(read.data(), values.data(), sizeof(double) * values.size()) != 0)
        throw WriteError(file, "", "reading it back gives other bytes than were written", "check the disk");
    }
}

/// The part of an array that belongs to the items here. For all processes together.
std::vector<double> read_shared(const fs::path& file, const Hdf5File& hdf5, const std::string& name,
                                const SharedArray& how) {
  const auto shape = hdf5.shape(arrays_group + name);
  const std::uint64_t size = shape.size() == 1 ? shape[0] : 0,
                      whole = static_cast<std::uint64_t>(how.order->whole() * how.entries);
  const std::uint64_t columns = whole == 0 ? 0 : size / whole;
  if (columns * whole != size || (columns > 1 && !how.columns))
    throw InputError(file.string(), name, fmt::format("has {} values, not {}", size, whole), another_mesh);
  std::vector<double> values;
  for (std::uint64_t column = 0; column < columns; ++column) {
    const auto stretch = hdf5.read_part<double>(
        arrays_group + name, column * whole + static_cast<std::uint64_t>(how.order->first() * how.entries),
        static_cast<std::uint64_t>(how.order->count() * how.entries));
    const auto here = how.order->from_stretches(stretch.data(), how.entries);
    values.insert(values.end(), here.begin(), here.end());
  }
  return values;
}

}  // namespace

fs::path checkpoint_file(const fs::path& folder) {
  return folder / "checkpoint.h5";
}

void write_checkpoint(const fs::path& file, const Checkpoint& checkpoint) {
  std::uint64_t size = 1 << 16;
  for (const auto& entry : checkpoint.arrays) size += sizeof(double) * entry.second.size() + 1024;
  auto hdf5 = Hdf5File::create_in_memory(file, block_size, size);
  write_contents(hdf5, checkpoint, {});

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

void write_checkpoint(const fs::path& file, const Checkpoint& checkpoint, const Communicator& processes,
                      const ArraySharing& sharing) {
  if (processes.is_alone()) return write_checkpoint(file, checkpoint);
  const SharedValues shared = shared_values(checkpoint, processes, sharing);
  const fs::path temporary = temporary_name(file);
  try {
    at_first(processes, [&] {
      remove_temporary(file);
      auto hdf5 = Hdf5File::create(temporary, file, block_size);
      write_contents(hdf5, checkpoint, shared);
      hdf5.close();
    });
    do_together(processes, [&] { write_stretches(temporary, file, shared, processes); });
    at_first(processes, [&] {
      std::ifstream stream(temporary, std::ios::binary);
      const Block block = block_for(checksum_behind_block(stream));
      stream.close();
      auto changed = FileInPlace(temporary).open();
      changed.write(0, block.data(), block.size());
      changed.close();
      replace_by_temporary(file);
    });
  } catch (...) {
    if (processes.is_first()) remove_temporary(file);
    throw;
  }
}

Checkpoint read_checkpoint(const fs::path& file) {
  return read_checkpoint(file, Communicator::alone(), {});
}

CheckpointReader::CheckpointReader(fs::path file, const Communicator& processes)
    : file_(std::move(file)), processes_(processes) {
  at_first(processes, [&] { verify(file_); });
  hdf5_ = std::make_unique<const Hdf5File>(Hdf5File::open(file_, false));
  head_.program = hdf5_->read_attribute("/", "program");
  head_.case_hash = hdf5_->read_attribute("/", "case_hash");
  head_.case_text = hdf5_->read_attribute("/", "case");
  head_.mesh_hash = hdf5_->read_attribute("/", "mesh_hash");
  head_.step = single<std::int64_t>(file_, *hdf5_, "/step");
  head_.time = single<double>(file_, *hdf5_, "/time");
  if (hdf5_->has("/arrays")) arrays_ = hdf5_->members("/arrays");
  if (hdf5_->has("/integers"))
    for (const auto& name : hdf5_->members("/integers"))
      head_.integers[name] = single<std::int64_t>(file_, *hdf5_, "/integers/" + name);
  if (hdf5_->has("/reals"))
    for (const auto& name : hdf5_->members("/reals"))
      head_.reals[name] = single<double>(file_, *hdf5_, "/reals/" + name);
}

CheckpointReader::~CheckpointReader() = default;

std::vector<double> CheckpointReader::array(const std::string& name, const std::optional<SharedArray>& how) const {
  if (how && !processes_.is_alone()) return read_shared(file_, *hdf5_, name, *how);
  return hdf5_->read<double>(arrays_group + name);
}

Checkpoint read_checkpoint(const fs::path& file, const Communicator& processes, const ArraySharing& sharing) {
  const CheckpointReader reader(file, processes);
  Checkpoint checkpoint = reader.head();
  for (const auto& name : reader.arrays())
    checkpoint.arrays[name] = reader.array(name, sharing ? sharing(name) : std::nullopt);
  return checkpoint;
}

void require_same_run(const fs::path& file, const Checkpoint& checkpoint, const std::string& program,
                      const std::string& case_hash, const std::string& mesh_hash, const std::string& difference) {
  if (checkpoint.program != program)
    throw InputError(file.string(), "program", "was written by " + checkpoint.program + ", not " + program,
                     "continue it with " + checkpoint.program);
  // The case first: its element and geometry decide what is made of a mesh file.
  if (checkpoint.case_hash != case_hash)
    throw InputError(file.string(), "case",
                     "belongs to another case (" +
                         (difference.empty() ? "hash " + checkpoint.case_hash + ", not " + case_hash : difference) +
                         ")",
                     "restart with the case file of that run; only names, files, steps, the end, solvers and output "
                     "may differ (docs/guide/running.md, Continuing a run)");
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
                     another_mesh);
  return found->second;
}

}  // namespace fsi
