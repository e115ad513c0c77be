#include "fields/vtk_file.hpp"

#include <fmt/format.h>
#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/error.hpp"

namespace fsi {

namespace {

constexpr const char* remedy = "write it anew as .vtu or .vtp";
constexpr int polygon = 7;

/// What is wrong with a file; read_vtk() adds its name.
struct Damaged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Tag {
  std::string name;  ///< "/Piece" where it ends one
  std::map<std::string, std::string> attributes;
  std::string_view content;  ///< up to the next tag

  std::string at(const std::string& attribute, const std::string& standard = "") const {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? standard : found->second;
  }
};

/// An attribute's value, in which some characters stand by names.
std::string named_characters(std::string_view text) {
  static constexpr std::pair<std::string_view, char> names[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string plain;
  while (!text.empty()) {
    std::size_t length = 1;
    char character = text.front();
    for (const auto& [name, meant] : names)
      if (text.substr(0, name.size()) == name) {
        length = name.size();
        character = meant;
      }
    plain += character;
    text.remove_prefix(length);
  }
  return plain;
}

std::vector<Tag> tags_of(std::string_view text) {
  std::vector<Tag> tags;
  for (auto begin = text.find('<'); begin != std::string_view::npos;) {
    if (text.substr(begin, 4) == "<!--") {
      const auto end = text.find("-->", begin);
      if (end == std::string_view::npos) throw Damaged("is cut off");
      begin = text.find('<', end);
      continue;
    }
    const auto end = text.find('>', begin);
    if (end == std::string_view::npos) throw Damaged("is cut off");
    const auto next = text.find('<', end);
    std::string_view inside = text.substr(begin + 1, end - begin - 1);
    Tag tag;
    const auto space = inside.find_first_of(" \t\r\n");
    tag.name = std::string(inside.substr(0, space));
    while (true) {
      const auto sign = inside.find('=');
      if (sign == std::string_view::npos || sign + 1 >= inside.size()) break;
      const auto first = inside.find_last_of(" \t\r\n", sign) + 1;
      const char quote = inside[sign + 1];
      const auto stop = inside.find(quote, sign + 2);
      if ((quote != '"' && quote != '\'') || stop == std::string_view::npos) throw Damaged("is no XML");
      tag.attributes[std::string(inside.substr(first, sign - first))] =
          named_characters(inside.substr(sign + 2, stop - sign - 2));
      inside.remove_prefix(stop + 1);
    }
    tag.content = text.substr(end + 1, next == std::string_view::npos ? next : next - end - 1);
    tags.push_back(std::move(tag));
    begin = next;
  }
  return tags;
}

std::string without_base64(std::string_view text, std::size_t characters) {
  if (text.size() < characters) throw Damaged("is cut off");
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text.substr(0, characters)) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (c == '=') break;
    if (value < 0) throw Damaged("is not coded in base64 where it says so");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes.push_back(static_cast<char>(bits >> held & 0xFF));
    }
  }
  return bytes;
}

constexpr std::size_t coded(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// Unpacks a block. \param whole  its size, set to that of what is found
bool unpack_zlib(const char* data, std::size_t size, char* to, std::size_t& whole) {
  uLongf length = whole;
  const int code = uncompress(reinterpret_cast<Bytef*>(to), &length, reinterpret_cast<const Bytef*>(data), size);
  whole = length;
  return code == Z_OK;
}
bool unpack_lzma(const char* data, std::size_t size, char* to, std::size_t& whole) {
  std::uint64_t most_memory = std::uint64_t{1} << 30;
  std::size_t read = 0, length = 0;
  const lzma_ret code = lzma_stream_buffer_decode(&most_memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(data),
                                                  &read, size, reinterpret_cast<std::uint8_t*>(to), &length, whole);
  whole = length;
  return code == LZMA_OK;
}

/// The arrays of one file.
class Arrays {
 public:
  Arrays(const Tag& root, std::optional<std::string_view> appended, bool raw)
      : appended_(appended), raw_(raw), wide_(root.at("header_type") == "UInt64") {
    const std::string order = root.at("byte_order", "LittleEndian"), packing = root.at("compressor");
    if (order != "LittleEndian" && order != "BigEndian") throw Damaged("has the unknown order of bytes " + order);
    turned_ = order == "BigEndian";
    if (packing == "vtkZLibDataCompressor")
      unpack_ = unpack_zlib;
    else if (packing == "vtkLZMADataCompressor")
      unpack_ = unpack_lzma;
    else if (!packing.empty())
      throw Damaged("is packed by " + packing + ", not by zlib or LZMA");
  }

  /// Of arrays that are none of numbers, as strings.
  static bool of_numbers(const std::string& type) { return reader_of(type) != nullptr; }

  std::vector<double> numbers(const Tag& array) const {
    const std::string format = array.at("format", "ascii"), type = array.at("type");
    const Reader reader = reader_of(type);
    if (reader == nullptr) throw Damaged("has an array of the type " + type + ", which is none of numbers");
    if (format == "ascii") return numbers_of_text(array.content);
    if (format == "binary") {
      std::string_view text = array.content;
      while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
      return reader(bytes_of(text, false), turned_);
    }
    if (!appended_) throw Damaged("has an appended array without AppendedData");
    const std::size_t offset = std::strtoull(array.at("offset", "0").c_str(), nullptr, 10);
    if (offset > appended_->size()) throw Damaged("is cut off");
    return reader(bytes_of(appended_->substr(offset), raw_), turned_);
  }

 private:
  static std::vector<double> numbers_of_text(std::string_view text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
      while (at != end && std::isspace(static_cast<unsigned char>(*at))) ++at;
      if (at == end) return numbers;
      double value = 0;
      const auto [stop, error] = std::from_chars(at, end, value);
      if (error == std::errc::invalid_argument) throw Damaged("has what is no number among its numbers");
      if (error == std::errc::result_out_of_range) value = std::strtod(std::string(at, stop).c_str(), nullptr);
      numbers.push_back(value);
      at = stop;
    }
  }

  std::size_t header_bytes() const { return wide_ ? 8 : 4; }
  std::size_t header(std::string_view bytes, std::size_t index) const {
    const std::size_t size = header_bytes();
    if (bytes.size() < (index + 1) * size) throw Damaged("is cut off");
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k)
      value |= std::uint64_t{static_cast<unsigned char>(bytes[index * size + (turned_ ? size - 1 - k : k)])} << (8 * k);
    return value;
  }

  /// The bytes of an array that begins here, raw or in base64, unpacked.
  std::string bytes_of(std::string_view from, bool raw) const {
    const std::size_t size = header_bytes();
    const auto plain = [&](std::size_t bytes) {
      return raw ? std::string(from.substr(0, std::min(bytes, from.size()))) : without_base64(from, coded(bytes));
    };
    const std::size_t first = header(plain(size), 0);
    if (first > most_bytes) throw Damaged("is damaged");
    if (unpack_ == nullptr) {
      const std::string all = plain(size + first);
      if (all.size() < size + first) throw Damaged("is cut off");
      return all.substr(size);
    }
    const std::size_t blocks = first, head_bytes = size * (3 + blocks);
    const std::string head = plain(head_bytes);
    std::size_t together = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t bytes = header(head, 3 + b);
      if (bytes > most_bytes || together > most_bytes - bytes) throw Damaged("is damaged");
      together += bytes;
    }
    std::string_view behind = from;
    behind.remove_prefix(std::min(behind.size(), raw ? head_bytes : coded(head_bytes)));
    const std::string data = raw ? std::string(behind.substr(0, std::min(together, behind.size())))
                                 : without_base64(behind, coded(together));
    std::string all;
    for (std::size_t b = 0, at = 0; b < blocks; ++b) {
      const std::size_t count = header(head, 3 + b), last = header(head, 2);
      std::size_t whole = b + 1 == blocks && last > 0 ? last : header(head, 1);
      if (whole > most_bytes || at + count > data.size()) throw Damaged("is cut off");
      const std::size_t before = all.size();
      all.resize(before + whole);
      if (!unpack_(data.data() + at, count, all.data() + before, whole)) throw Damaged("holds what cannot be unpacked");
      all.resize(before + whole);
      at += count;
    }
    return all;
  }

  using Reader = std::vector<double> (*)(const std::string& bytes, bool turned);
  template <class Number>
  static std::vector<double> as(const std::string& bytes, bool turned) {
    constexpr std::size_t size = sizeof(Number);
    std::vector<double> numbers(bytes.size() / size);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      char of_number[size];
      std::memcpy(of_number, bytes.data() + i * size, size);
      if (turned) std::reverse(of_number, of_number + size);
      Number value;
      std::memcpy(&value, of_number, size);
      numbers[i] = static_cast<double>(value);
    }
    return numbers;
  }
  /// Null for what is no type of numbers.
  static Reader reader_of(const std::string& type) {
    static const std::map<std::string, Reader> readers{{"Float64", as<double>},     {"Float32", as<float>},
                                                       {"Int64", as<std::int64_t>}, {"UInt64", as<std::uint64_t>},
                                                       {"Int32", as<std::int32_t>}, {"UInt32", as<std::uint32_t>},
                                                       {"Int16", as<std::int16_t>}, {"UInt16", as<std::uint16_t>},
                                                       {"Int8", as<std::int8_t>},   {"UInt8", as<std::uint8_t>}};
    const auto found = readers.find(type);
    return found == readers.end() ? nullptr : found->second;
  }

  static constexpr std::size_t most_bytes = std::size_t{1} << 32;
  std::optional<std::string_view> appended_;
  bool raw_, wide_, turned_ = false;
  bool (*unpack_)(const char* data, std::size_t size, char* to, std::size_t& whole) = nullptr;
};

/// The arrays of one piece as the file names them.
struct Piece {
  bool is_surface = false;
  std::int64_t others = 0;  ///< vertices, lines and strips of a surface
  std::vector<double> points, connectivity, offsets, types;
  std::vector<VtkMesh::Array> arrays;
};

bool is_read(const VtkMesh::Array& array, const VtkWanted& wanted) {
  return array.of_numbers && (!wanted || wanted(array));
}

void add(const Piece& piece, const VtkWanted& wanted, VtkMesh& mesh) {
  const auto first = static_cast<double>(mesh.nodes.size());
  const std::size_t cells_before = mesh.cells.size();
  if (piece.points.size() % 3 != 0) throw Damaged("has points without three coordinates");
  for (std::size_t i = 0; i + 2 < piece.points.size(); i += 3)
    mesh.nodes.push_back({piece.points[i], piece.points[i + 1], piece.points[i + 2]});
  if (!piece.is_surface && piece.types.size() != piece.offsets.size())
    throw Damaged(fmt::format("has {} kinds for {} cells", piece.types.size(), piece.offsets.size()));
  std::size_t begin = 0;
  for (std::size_t c = 0; c < piece.offsets.size(); ++c) {
    const double end = piece.offsets[c];
    if (!(end >= static_cast<double>(begin) && end <= static_cast<double>(piece.connectivity.size())))
      throw Damaged("has cells that are none of its points");
    auto& cell = mesh.cells.emplace_back();
    for (; begin < static_cast<std::size_t>(end); ++begin) {
      const double node = piece.connectivity[begin];
      const std::size_t points = piece.points.size() / 3;
      if (!(node >= 0 && node < static_cast<double>(points))) throw Damaged("has cells that are none of its points");
      cell.push_back(static_cast<int>(first + node));
    }
    mesh.kinds.push_back(piece.is_surface ? polygon : static_cast<int>(piece.types[c]));
  }
  ++mesh.pieces;
  for (const auto& array : piece.arrays) {
    const std::size_t places = array.of_cells ? mesh.cells.size() - cells_before : piece.points.size() / 3;
    // Cell fields of surfaces have numbers for vertices, lines and strips, too.
    if (is_read(array, wanted) && array.values.size() != places * static_cast<std::size_t>(array.components) &&
        !(array.of_cells && piece.others > 0))
      throw Damaged(fmt::format("has {} numbers of \"{}\" for {} {}", array.values.size(), array.name, places,
                                array.of_cells ? "cells" : "points"));
    const auto known = std::find_if(mesh.arrays.begin(), mesh.arrays.end(), [&](const auto& other) {
      return other.name == array.name && other.of_cells == array.of_cells;
    });
    if (known == mesh.arrays.end()) {
      mesh.arrays.push_back(array);
      continue;
    }
    if (known->components != array.components || known->of_numbers != array.of_numbers)
      throw Damaged("has pieces that differ in what \"" + array.name + "\" is");
    known->values.insert(known->values.end(), array.values.begin(), array.values.end());
    ++known->pieces;
  }
}

VtkMesh mesh_of(const std::string& text, const VtkWanted& wanted) {
  if (text.rfind("version https://git-lfs", 0) == 0) throw Damaged("is a pointer of Git LFS in the place of the file");
  if (text.find("<VTKFile") == std::string::npos) throw Damaged("is no file of VTK");
  if (text.rfind("</VTKFile>") == std::string::npos) throw Damaged("is cut off");
  std::string_view xml = text;
  std::optional<std::string_view> appended;
  bool raw = false;
  if (const auto at = text.find("<AppendedData"); at != std::string::npos) {
    const auto end = text.find('>', at), mark = text.find('_', end);
    if (end == std::string::npos || mark == std::string::npos) throw Damaged("is cut off");
    const std::string_view tag = xml.substr(at, end - at);
    raw = tag.find("\"raw\"") != std::string_view::npos || tag.find("'raw'") != std::string_view::npos;
    appended = xml.substr(mark + 1);
    xml = xml.substr(0, at);
  }
  VtkMesh mesh;
  std::optional<Arrays> arrays;
  std::string section;
  Piece piece;
  for (const Tag& tag : tags_of(xml)) {
    if (tag.name == "VTKFile") {
      if (tag.at("type") != "UnstructuredGrid" && tag.at("type") != "PolyData")
        throw Damaged("holds no UnstructuredGrid and no PolyData of VTK");
      arrays.emplace(tag, appended, raw);
      mesh.is_surface = tag.at("type") == "PolyData";
    } else if (tag.name == "Piece") {
      piece = {};
      piece.is_surface = mesh.is_surface;
      const auto count = [&](const char* what) { return std::strtoll(tag.at(what, "0").c_str(), nullptr, 10); };
      const auto lines = count("NumberOfVerts") + count("NumberOfLines"), strips = count("NumberOfStrips");
      piece.others = lines + strips;
      mesh.lines += lines;
      mesh.strips += strips;
    } else if (tag.name == "/Piece") {
      add(piece, wanted, mesh);
    } else if (tag.name == "DataArray") {
      if (!arrays) throw Damaged("is no file of VTK");
      const std::string name = tag.at("Name");
      if (section == "Points") piece.points = arrays->numbers(tag);
      if (section == "Cells" || section == "Polys") {
        if (name == "connectivity") piece.connectivity = arrays->numbers(tag);
        if (name == "offsets") piece.offsets = arrays->numbers(tag);
        if (name == "types") piece.types = arrays->numbers(tag);
      }
      if (section == "PointData" || section == "CellData") {
        VtkMesh::Array array{name,
                             section == "CellData",
                             Arrays::of_numbers(tag.at("type")),
                             std::max(1, std::atoi(tag.at("NumberOfComponents", "1").c_str())),
                             {},
                             1};
        if (is_read(array, wanted)) array.values = arrays->numbers(tag);
        piece.arrays.push_back(std::move(array));
      }
    } else if (tag.name == "Points" || tag.name == "Cells" || tag.name == "Polys" || tag.name == "PointData" ||
               tag.name == "CellData" || tag.name == "Verts" || tag.name == "Lines" || tag.name == "Strips" ||
               tag.name == "FieldData") {
      section = tag.name;
    }
  }
  if (!arrays) throw Damaged("is no file of VTK");
  return mesh;
}

}  // namespace

VtkMesh read_vtk(const std::string& text, const std::string& file, const VtkWanted& wanted) {
  try {
    return mesh_of(text, wanted);
  } catch (const Damaged& damage) {
    throw InputError(file, "", damage.what(), remedy);
  }
}

}  // namespace fsi
