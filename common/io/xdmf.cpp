#include "io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "io/atomic_file.hpp"
#include "io/checked_file.hpp"

namespace fsi {

namespace {

/// XDMF's name of cells with so many nodes.
const char* topology_of(int nodes_per_cell) {
  switch (nodes_per_cell) {
    case 3:
      return "Triangle";
    case 4:
      return "Tetrahedron";
    case 6:
      return "Triangle_6";
    default:
      return "Tetrahedron_10";
  }
}

/// XDMF's name of a field with so many components.
const char* attribute_of(int components) {
  assert(components == 1 || components == 3 || components == 6);
  return components == 1 ? "Scalar" : components == 3 ? "Vector" : "Tensor6";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string data_item(const std::string& dimensions, bool is_real, const std::string& file,
                      const std::string& dataset) {
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}</DataItem>",
                     dimensions, is_real ? "Float" : "Int", is_real ? 8 : 4, escaped(file), dataset);
}

constexpr const char* document_head =
    "<?xml version=\"1.0\"?>\n"
    "<Xdmf Version=\"3.0\">\n"
    "  <Domain>\n";
constexpr const char* media_head = "    <Grid Name=\"media\" GridType=\"Collection\" CollectionType=\"Spatial\">\n";
constexpr const char* grid_tail = "      </Grid>\n";
constexpr const char* media_tail = "    </Grid>\n";
constexpr const char* document_tail = "  </Domain>\n</Xdmf>\n";

constexpr std::string_view slot_head = "        <?slot  >\n";
constexpr std::size_t free_byte = slot_head.size() - 3;  // a blank before ">", and "?" once the slot is in use
constexpr std::string_view slot_tail = "<?slot?>\n", free_tail = "      ?>\n";
static_assert(slot_tail.size() == free_tail.size());

/// The entry with the longest text: its numbers have as many digits as possible.
ListedEntry longest_entry(const FieldGrid& grid, std::size_t place) {
  ListedEntry entry;
  entry.entry.step = {std::numeric_limits<std::int64_t>::max(), -2.2250738585072014e-308};
  entry.entry.fields.resize(place + 1);
  entry.entry.fields[place].assign(grid.fields.size(), 1);
  entry.file = FieldsPart::name(std::numeric_limits<std::int64_t>::max() / FieldsPart::capacity);
  return entry;
}

/// One entry in the list of a grid.
std::string grid_text(const FieldGrid& grid, std::size_t cells, bool layered, const ListedEntry& listed,
                      std::size_t place) {
  const auto nodes = point_count(grid);
  const FieldStep& step = listed.entry.step;
  const auto& file = listed.file;
  const auto prefix = "/" + grid.name;
  std::string text = fmt::format(
      "        <Grid Name=\"step {}\" GridType=\"Uniform\">\n          <Time Value=\"{}\"/>\n", step.step, step.time);
  text += fmt::format("          <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n",
                      topology_of(grid.nodes_per_cell), cells,
                      data_item(fmt::format("{} {}", cells, grid.nodes_per_cell), false, file, prefix + "/cells"));
  text += fmt::format("          <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                      data_item(fmt::format("{} 3", nodes), true, file, prefix + "/points"));
  if (layered)
    text += fmt::format("          <Attribute Name=\"layer\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n",
                        data_item(fmt::format("{}", cells), false, file, prefix + "/layer"));
  for (std::size_t f = 0; f < grid.fields.size(); ++f) {
    const FieldDescription& field = grid.fields[f];
    if (listed.entry.fields.at(place).at(f) == 0) continue;
    const auto places = field.of_cells ? cells : nodes;
    const auto shape =
        field.components == 1 ? fmt::format("{}", places) : fmt::format("{} {}", places, field.components);
    text += fmt::format(
        "          <Information Name=\"unit of {}\" Value=\"{}\"/>\n"
        "          <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
        escaped(field.name), escaped(field.unit), escaped(field.name), attribute_of(field.components),
        field.of_cells ? "Cell" : "Node",
        data_item(shape, true, file, field_dataset(grid.name, field.name, step.step)));
  }
  return text + "        </Grid>\n";
}

std::string free_slot(std::size_t length) {
  std::string text(slot_head);
  text.resize(length - free_tail.size(), ' ');
  return text.append(free_tail);
}

/// Slots of a document that has `count` entries and will have `total`.
std::int64_t slots_for(std::int64_t count, std::int64_t total) {
  std::int64_t slots = XdmfDocument::first_slots;
  while (slots < count) slots *= 2;
  return std::max(count, std::min(slots, total));
}

}  // namespace

XdmfDocument::XdmfDocument(std::filesystem::path file, std::vector<FieldGrid> grids)
    : path_(std::move(file)), grids_(std::move(grids)) {
  places_.resize(grids_.size());
  std::iota(places_.begin(), places_.end(), std::size_t{0});
  tail_ =
      (grids_.empty() ? std::string(document_head) + media_head : std::string(grid_tail)) + media_tail + document_tail;
  prepare(std::string(document_head) + media_head);
}

XdmfDocument::XdmfDocument(std::filesystem::path file, const std::vector<FieldGrid>& grids, std::size_t medium)
    : path_(std::move(file)), grids_{grids.at(medium)}, places_{medium}, tail_(std::string(grid_tail) + document_tail) {
  prepare(document_head);
}

void XdmfDocument::prepare(const std::string& first_head) {
  for (std::size_t g = 0; g < grids_.size(); ++g) {
    FieldGrid& grid = grids_[g];
    cells_.push_back(cell_count(grid));
    layered_.push_back(is_layered(grid));
    grid.cells = {};
    grid.layer = {};
    head_.push_back(fmt::format("{}      <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                                g == 0 ? first_head : grid_tail, escaped(grid.name)));
    const auto text = grid_text(grid, cells_[g], layered_[g], longest_entry(grid, places_[g]), places_[g]);
    length_.push_back(slot_head.size() + text.size() + slot_tail.size());
  }
}

std::string XdmfDocument::slot_text(std::size_t grid, const ListedEntry& entry, bool in_use) const {
  std::string text(slot_head);
  text += grid_text(grids_[grid], cells_[grid], layered_[grid], entry, places_[grid]);
  assert(text.size() + slot_tail.size() <= length_[grid]);
  assert(text[free_byte] == ' ' && text[free_byte + 1] == '>');
  if (in_use) text[free_byte] = '?';
  text.resize(length_[grid] - slot_tail.size(), ' ');
  return text.append(slot_tail);
}

std::uint64_t XdmfDocument::place_of(std::size_t grid, std::int64_t slot) const {
  std::uint64_t place = 0;
  for (std::size_t g = 0; g < grid; ++g) place += head_[g].size() + static_cast<std::uint64_t>(slots_) * length_[g];
  return place + head_[grid].size() + static_cast<std::uint64_t>(slot) * length_[grid];
}

void XdmfDocument::rewrite(std::int64_t count, const Slot& slot) {
  const std::int64_t slots = slots_for(count, total_);
  constexpr std::size_t piece = 1 << 20;  // bytes, so that the document is never in memory as a whole
  try {
    auto file = CheckedFile::create_new(temporary_name(path_), path_);
    std::string text;
    const auto add = [&](const std::string& further, bool last = false) {
      text += further;
      if (text.size() < piece && !last) return;
      file.write(text);
      text.clear();
    };
    for (std::size_t g = 0; g < grids_.size(); ++g) {
      add(head_[g]);
      for (std::int64_t i = 0; i < count; ++i) add(slot(g, i));
      const std::string free = free_slot(length_[g]);
      for (std::int64_t i = count; i < slots; ++i) add(free);
    }
    add(tail_, true);
    file.close();
  } catch (...) {
    remove_temporary(path_);
    throw;
  }
  replace_by_temporary(path_);
  file_.emplace(path_);
  count_ = count;
  slots_ = slots;
}

void XdmfDocument::replace(std::int64_t count, const std::function<ListedEntry(std::int64_t)>& entry,
                           std::int64_t total) {
  total_ = total;
  rewrite(count, [&](std::size_t g, std::int64_t i) { return slot_text(g, entry(i), true); });
}

void XdmfDocument::add(const ListedEntry& entry) {
  assert(file_);
  if (count_ == slots_) {
    auto old = file_->open();
    const std::int64_t count = count_ + 1;
    rewrite(count, [&](std::size_t g, std::int64_t i) {
      return i < count_ ? old.read(place_of(g, i), length_[g]) : slot_text(g, entry, true);
    });
    return;
  }
  auto file = file_->open();
  for (std::size_t g = 0; g < grids_.size(); ++g) {
    const auto text = slot_text(g, entry, false);
    file.write(place_of(g, count_), text.data(), text.size());
  }
  for (std::size_t g = 0; g < grids_.size(); ++g) file.write(place_of(g, count_) + free_byte, "?", 1);
  file.close();
  ++count_;
}

}  // namespace fsi
