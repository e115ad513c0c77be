#pragma once

// HDF5 for fields and checkpoints; nothing else should need the library.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// An HDF5 identifier that closes itself.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;

  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }
  bool reset();                 ///< false when closing failed, e.g. because the disk is full; never closes again
  void abandon() { id_ = -1; }  ///< never to be closed

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// An HDF5 file of contiguous datasets of double, int32, int64 or uint8. All storage is reserved when a dataset is
/// created, so that writing its values later changes nothing but raw data. Library messages are silenced. Failures of
/// reading throw InputError with file and dataset, those of writing WriteError.
///
/// The library does not survive a full disk: it keeps what it could not write, tries again whenever it closes or ends,
/// and crashes. So a file that could not be written is abandoned, the end of the process closes it, and the library
/// does nothing at exit.
class Hdf5File {
 public:
  /// A new file in place of an old one. It is removed again unless it is closed by close().
  /// \param shown_as    name in messages; empty: the file's
  /// \param user_block  bytes before what the library writes: 0, or a power of two from 512
  static Hdf5File create(const std::filesystem::path& file, const std::filesystem::path& shown_as = {},
                         std::uint64_t user_block = 0);
  /// A file that is only ever in memory; see append_image().
  /// \param shown_as    name in messages
  /// \param user_block  bytes that will stand before the image in a file: 0, or a power of two from 512
  /// \param size        bytes expected in it; more are possible
  static Hdf5File create_in_memory(const std::filesystem::path& shown_as, std::uint64_t user_block, std::uint64_t size);
  static Hdf5File open(const std::filesystem::path& file, bool for_writing);
  /// Opens an existing file for writing, for all processes together: all make the same calls in the same order.
  /// \param shown_as  name in messages
  static Hdf5File open_together(const std::filesystem::path& file, const std::filesystem::path& shown_as,
                                const Communicator& processes);

  bool has(const std::string& path) const;
  std::vector<std::uint64_t> shape(const std::string& dataset) const;
  /// Where the values of a dataset begin, bytes from the file's start.
  std::uint64_t place_of(const std::string& dataset) const;
  std::vector<std::string> members(const std::string& group) const;  ///< by name

  /// Creates groups on the way; the values are undefined until they are written.
  template <class Value>
  void create_dataset(const std::string& dataset, const std::vector<std::uint64_t>& shape);
  template <class Value>
  void write(const std::string& dataset, const Value* values);
  template <class Value>
  std::vector<Value> read(const std::string& dataset) const;

  /// Writes `count` numbers of a dataset, row after row, from number `first` on. In a file of open_together() each
  /// process writes its own, collectively, perhaps none. \returns false if that failed: all processes must still make
  /// the next calls, and then abandon the file in place of closing it.
  template <class Value>
  [[nodiscard]] bool write_part(const std::string& dataset, std::uint64_t first, std::uint64_t count,
                                const Value* values);
  /// Likewise reads, each process by itself.
  template <class Value>
  std::vector<Value> read_part(const std::string& dataset, std::uint64_t first, std::uint64_t count) const;
  /// Puts a file of open_together() on disk. \returns false if that failed
  [[nodiscard]] bool sync_together();
  /// Leaves a file that could not be written unclosed.
  void abandon() { file_.abandon(); }

  template <class Value>
  void write_new(const std::string& dataset, const std::vector<std::uint64_t>& shape, const Value* values) {
    create_dataset<Value>(dataset, shape);
    write(dataset, values);
  }

  void write_attribute(const std::string& object, const std::string& name, const std::string& text);
  std::string read_attribute(const std::string& object, const std::string& name) const;

  /// Appends the bytes of the file, without its user block, to `bytes`.
  void append_image(std::string& bytes);

  /// Hands everything to the operating system.
  void flush();
  /// Flushes and closes. A file that was written must be closed by this, since the destructor cannot report errors.
  void close();

 private:
  Hdf5File(std::filesystem::path path, Hdf5Handle handle) : path_(std::move(path)), file_(std::move(handle)) {}

  /// Removes the file in its destructor, unless forget() was called.
  class Unfinished {
   public:
    Unfinished() = default;
    explicit Unfinished(std::filesystem::path file) : file_(std::move(file)) {}
    ~Unfinished();
    Unfinished(Unfinished&& other) noexcept { file_.swap(other.file_); }
    Unfinished& operator=(Unfinished&& other) noexcept {
      file_.swap(other.file_);
      return *this;
    }
    void forget() { file_.clear(); }

   private:
    std::filesystem::path file_;
  };

  [[noreturn]] void refuse_reading(const std::string& object) const;
  [[noreturn]] void refuse_writing(const std::string& object);
  /// Closes an object of a file that is written.
  void finish(Hdf5Handle& handle, const std::string& object);

  std::filesystem::path path_;
  Unfinished unfinished_;  // before the handle, which is closed first
  Hdf5Handle file_;
  Hdf5Handle transfer_;  ///< how parts are written: together or not
};

}  // namespace fsi
