#include "base/input_file.hpp"

#include <fmt/format.h>

#include <system_error>

#include "base/error.hpp"

namespace fsi {

void require_regular_file(const std::filesystem::path& file, const InputFileKind& kind) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto type = fs::status(file, error).type();
  if (type == fs::file_type::not_found) throw InputError(file.string(), "", kind.missing, kind.missing_remedy);
  if (type == fs::file_type::none || type == fs::file_type::unknown)
    throw InputError(file.string(), "", "cannot be looked at (" + error.message() + ")",
                     "check the path and its permissions");
  if (type == fs::file_type::directory) throw InputError(file.string(), "", "is a folder", kind.remedy);
  if (type != fs::file_type::regular)
    throw InputError(file.string(), "", "is a pipe, socket or device, not a file", kind.remedy);
  const auto bytes = fs::file_size(file, error);
  if (!error && bytes > kind.largest)
    throw InputError(file.string(), "", fmt::format("has {} bytes, where at most {} are read", bytes, kind.largest),
                     kind.remedy);
}

void drop_byte_order_mark(std::string& line) {
  const std::string mark = "\xEF\xBB\xBF";
  if (line.compare(0, mark.size(), mark) == 0) line.erase(0, mark.size());
}

}  // namespace fsi
