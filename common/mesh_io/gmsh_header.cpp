#include "mesh_io/gmsh_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "mesh_io/gmsh_file.hpp"
#include "mesh_io/gmsh_scanner.hpp"

namespace fsi {

namespace {

constexpr std::size_t window = std::size_t{1} << 20;  // of the file's begin, where $Nodes is looked for
constexpr std::int64_t walked_blocks = 10000;         // each costs a look into the file

/// Reads pieces of a file, by their places.
class Header {
 public:
  Header(const std::filesystem::path& path, std::uint64_t size)
      : file_(path.string()), stream_(path, std::ios::binary), size_(size) {}

  void check() {
    const std::string begin = text_at(0, window);
    char version[8] = "";
    int binary = 0;
    if (std::sscanf(begin.c_str(), "$MeshFormat %7s %d", version, &binary) != 2) return;
    const bool version_41 = std::strcmp(version, "4.1") == 0;
    if (!version_41 && std::strcmp(version, "2.2") != 0) return;
    const std::size_t nodes = begin.find("\n$Nodes");
    const std::size_t line = nodes == std::string::npos ? nodes : begin.find('\n', nodes + 1);
    if (line == std::string::npos) return;
    position_ = line + 1;
    section_ = "$Nodes";
    if (binary == 1 && version_41) {
      check_binary_41();
      return;
    }
    long long first = 0, second = 0;
    const int read = std::sscanf(begin.c_str() + position_, "%lld %lld", &first, &second);
    if (read < (version_41 ? 2 : 1)) return;
    if (binary == 0) {
      require_bytes("nodes", version_41 ? second : first, 8);  // a tag and three coordinates with their blanks
      return;
    }
    const std::size_t end = begin.find('\n', position_);
    if (end == std::string::npos) return;
    position_ = end + 1;
    pass("nodes", first, 28);
    end_section();
  }

 private:
  std::string text_at(std::uint64_t position, std::size_t count) {
    std::string text(std::min<std::uint64_t>(count, size_ - std::min(position, size_)), '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(position));
    stream_.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream_.gcount()));
    return text;
  }

  /// The next number of binary data.
  template <class T>
  T next() {
    const std::string bytes = text_at(position_, sizeof(T));
    if (bytes.size() < sizeof(T)) fail("the file ends in its data");
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, section_, problem, GmshScanner::default_remedy);
  }

  void require_bytes(const char* what, long long count, std::uint64_t each) const {
    const std::uint64_t left = size_ - std::min(position_, size_);
    if (count < 0 || static_cast<std::uint64_t>(count) > left / each)
      fail(fmt::format("the number of {} is {}, but only {} bytes are left", what, count, left));
  }

  void pass(const char* what, std::int64_t count, std::uint64_t each) {
    require_bytes(what, count, std::max<std::uint64_t>(1, each));
    position_ += static_cast<std::uint64_t>(count) * each;
  }

  /// Advances to the next text that is not blank; that text.
  std::string after_blanks() {
    const std::string text = text_at(position_, 64);
    const std::size_t start = std::min(text.find_first_not_of(" \r\n\t"), text.size());
    position_ += start;
    return text.substr(start);
  }

  void end_section() {
    const std::string expected = "$End" + section_.substr(1);
    if (after_blanks().compare(0, expected.size(), expected) != 0)
      fail(fmt::format("expected {} at byte {}, where the counts end", expected, position_));
    position_ += expected.size();
    const std::string behind = after_blanks();
    if (position_ < size_ && (behind.empty() || behind[0] != '$'))
      fail(fmt::format("expected the begin of a section at byte {}", position_));
  }

  /// Passes over a section of nodes or elements; false where its end cannot be found, or only slowly.
  template <class BytesOfOne>
  bool walk(const char* what, std::uint64_t least, const BytesOfOne& bytes_of_one) {
    const auto blocks = next<std::int64_t>(), total = next<std::int64_t>();
    position_ += 16;  // smallest and largest tag
    require_bytes("blocks", blocks, 20);
    require_bytes(what, total, least);
    if (blocks > walked_blocks) return false;
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::optional<std::uint64_t> each = bytes_of_one();
      if (!each) return false;
      pass(what, next<std::int64_t>(), *each);
    }
    end_section();
    return true;
  }

  void check_binary_41() {
    const bool whole = walk("nodes", 32, [this]() -> std::optional<std::uint64_t> {
      const auto dimension = next<std::int32_t>();
      next<std::int32_t>();
      const auto parametric = next<std::int32_t>();
      if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1) return std::nullopt;
      return 32 + 8 * static_cast<std::uint64_t>(parametric * dimension);
    });
    if (!whole || after_blanks().compare(0, 10, "$Elements\n") != 0) return;
    section_ = "$Elements";
    position_ += 10;
    walk("elements", 16, [this]() -> std::optional<std::uint64_t> {
      next<std::int32_t>();
      next<std::int32_t>();
      const GmshType* type = gmsh_type(next<std::int32_t>());
      if (type == nullptr) return std::nullopt;
      return 8 * (1 + static_cast<std::uint64_t>(type->nodes));
    });
  }

  std::string file_, section_;
  std::ifstream stream_;
  std::uint64_t size_, position_ = 0;
};

}  // namespace

void check_gmsh_header(const std::filesystem::path& path, double room) {
  std::error_code failure;
  const std::uint64_t size = std::filesystem::file_size(path, failure);
  if (failure || size < large_gmsh_file) return;
  Header(path, size).check();
  if (gmsh_reading_bytes(size) > room)
    throw InputError(
        path.string(), "",
        fmt::format("the file has {}, reading it takes about {}, and {} of memory is available",
                    memory_text(static_cast<double>(size)), memory_text(gmsh_reading_bytes(size)), memory_text(room)),
        "take a coarser mesh or a machine with more memory");
}

}  // namespace fsi
