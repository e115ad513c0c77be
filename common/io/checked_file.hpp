#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace fsi {

/// A regular file that is written by the operating system's own calls, without a buffer: what write() has returned from
/// is in the system's hands, and the result of every call is looked at. All functions throw WriteError.
class CheckedFile {
 public:
  /// Empties the file or makes it; bytes are added at its end. Devices, pipes and folders are refused untouched.
  static CheckedFile create(const std::filesystem::path& file);
  /// Goes on at the end of the file; makes it where there is none. Refuses what create() refuses.
  static CheckedFile append(const std::filesystem::path& file);
  /// A file that is there, to be synchronised. \param shown_as  name in messages
  static CheckedFile existing(const std::filesystem::path& file, const std::filesystem::path& shown_as);
  /// A file that did not exist before: an old one of this name is removed, a link is not followed.
  /// \param shown_as  name in messages
  static CheckedFile create_new(const std::filesystem::path& file, const std::filesystem::path& shown_as);

  /// Closes the file, if close() has not; whoever wants to know whether that worked calls close().
  ~CheckedFile();
  CheckedFile(CheckedFile&& other) noexcept;
  CheckedFile& operator=(CheckedFile&& other) noexcept;

  /// All of the bytes.
  void write(std::string_view bytes);
  /// Whether the file still stands under its name, as large as this object has left it: neither deleted, replaced nor
  /// cut by somebody else. \throws WriteError when it does not
  void require_undisturbed() const;
  /// The same without a look at its size, for files that others may write to.
  void require_in_place() const;
  /// Cuts the file to `size` bytes, as well as it goes: for what a failed write has left.
  void cut_to(std::uint64_t size) noexcept;
  /// Bytes in the file, as far as this object knows.
  std::uint64_t size() const { return size_; }
  /// Onto the disk.
  void synchronise();
  /// The file is closed in any case, never twice.
  void close();

 private:
  CheckedFile(std::filesystem::path shown_as, int descriptor);
  [[noreturn]] void fail(int number) const;

  std::filesystem::path path_;  ///< as shown in messages
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Puts the names in a folder onto the disk: what was created and renamed there survives a loss of power.
/// \throws WriteError
void synchronise_folder(const std::filesystem::path& folder);

/// \throws WriteError when something stands under the name that is no regular file, such as a device
void require_still_regular(const std::filesystem::path& file);

}  // namespace fsi
