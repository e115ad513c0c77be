#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace fsi {

/// A regular file that is written by system calls, without a buffer: what write() has returned from is in the system's
/// hands, and the result of every call is checked. All functions that are not noexcept throw WriteError.
class CheckedFile {
 public:
  /// Empties the file or makes it; bytes are added at its end. Devices, pipes and folders are refused untouched.
  static CheckedFile create(const std::filesystem::path& file);
  /// Continues at the end of the file; makes it if there is none. Refuses what create() refuses.
  static CheckedFile append(const std::filesystem::path& file);
  /// Opens an existing file, for synchronise(). \param shown_as  name in messages
  static CheckedFile existing(const std::filesystem::path& file, const std::filesystem::path& shown_as);
  /// Makes a new file: an old one of this name is removed, a link is not followed.
  /// \param shown_as  name in messages
  static CheckedFile create_new(const std::filesystem::path& file, const std::filesystem::path& shown_as);

  /// Closes the file if close() has not, and ignores errors of that.
  ~CheckedFile();
  CheckedFile(CheckedFile&& other) noexcept;
  CheckedFile& operator=(CheckedFile&& other) noexcept;

  /// Writes all of the bytes at the end.
  void write(std::string_view bytes);
  /// Refuses a file that is no longer under its name or has another size than this object left: deleted, replaced, cut
  /// or lengthened by something else.
  void require_undisturbed() const;
  /// The same without its size, for files that others may write to.
  void require_in_place() const;
  /// Cuts the file to `size` bytes if the system allows it: removes what a failed write has left.
  void cut_to(std::uint64_t size) noexcept;
  /// Bytes in the file, as far as this object knows.
  std::uint64_t size() const { return size_; }
  /// Waits until what was written is on disk.
  void synchronise();
  /// Closes the file, also when it throws; does nothing the second time.
  void close();

 private:
  CheckedFile() = default;
  CheckedFile(std::filesystem::path shown_as, int descriptor);
  [[noreturn]] void fail(int number) const;

  std::filesystem::path path_;  ///< as shown in messages
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Puts the names in a folder on disk: what was created and renamed there survives a loss of power.
/// \throws WriteError
void synchronise_folder(const std::filesystem::path& folder);

/// \throws WriteError when anything but a regular file has this name, such as a device
void require_still_regular(const std::filesystem::path& file);

}  // namespace fsi
