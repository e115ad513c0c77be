#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace fsi {

/// A finished file whose bytes are overwritten later without changing its length. It is opened for each change, so that
/// a file that was removed or replaced meanwhile is noticed. All functions throw WriteError.
class FileInPlace {
 public:
  /// Takes the file that has this name now.
  explicit FileInPlace(std::filesystem::path file);

  const std::filesystem::path& path() const { return path_; }

  /// The file, open for changes.
  class Opened {
   public:
    Opened(Opened&& other) noexcept;
    Opened& operator=(Opened&&) = delete;
    ~Opened();

    /// Within the file's length.
    void write(std::uint64_t offset, const void* bytes, std::size_t size);
    std::string read(std::uint64_t offset, std::size_t size);
    /// Waits until what was written is on disk.
    void sync();
    /// Closes the file; unlike the destructor it throws.
    void close();

   private:
    friend class FileInPlace;
    Opened(const std::filesystem::path& path, int descriptor) : path_(path), descriptor_(descriptor) {}

    const std::filesystem::path& path_;
    int descriptor_;
  };

  /// Opens the file. Refuses one that has been replaced since the constructor, or has another length.
  Opened open() const;

 private:
  std::filesystem::path path_;
  std::uint64_t device_ = 0, number_ = 0, size_ = 0;
};

}  // namespace fsi
