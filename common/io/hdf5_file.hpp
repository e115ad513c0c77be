#pragma once

// Shared by fields and checkpoints; nothing else should need HDF5.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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
  bool reset();  ///< false when closing failed, e.g. because the disk is full

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// An HDF5 file of contiguous datasets of double, int32, int64 or uint8. All storage is reserved when a dataset is
/// created, so that writing its values later changes nothing but raw data. Library messages are silenced; failures
/// throw InputError with file and dataset.
class Hdf5File {
 public:
  /// \param user_block  bytes left free at the beginning: 0, or a power of two from 512
  static Hdf5File create(const std::filesystem::path& file, std::uint64_t user_block = 0);
  static Hdf5File open(const std::filesystem::path& file, bool for_writing);

  bool has(const std::string& path) const;
  std::vector<std::uint64_t> shape(const std::string& dataset) const;
  std::vector<std::string> members(const std::string& group) const;  ///< by name

  /// Creates groups on the way; the values are undefined until they are written.
  template <class Value>
  void create_dataset(const std::string& dataset, const std::vector<std::uint64_t>& shape);
  template <class Value>
  void write(const std::string& dataset, const Value* values);
  template <class Value>
  std::vector<Value> read(const std::string& dataset) const;

  template <class Value>
  void write_new(const std::string& dataset, const std::vector<std::uint64_t>& shape, const Value* values) {
    create_dataset<Value>(dataset, shape);
    write(dataset, values);
  }

  void write_attribute(const std::string& object, const std::string& name, const std::string& text);
  std::string read_attribute(const std::string& object, const std::string& name) const;

  /// Hands everything to the operating system.
  void flush();
  /// Flushes and closes; errors that a destructor would swallow are thrown.
  void close();

 private:
  Hdf5File(std::filesystem::path path, Hdf5Handle handle) : path_(std::move(path)), file_(std::move(handle)) {}

  [[noreturn]] void refuse_reading(const std::string& object) const;
  [[noreturn]] void refuse_writing(const std::string& object) const;

  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace fsi
