#include "meshes/cell_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <variant>

#include "base/error.hpp"
#include "io/last_fields.hpp"
#include "mesh/facets.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

/// Where a vertex is, whichever plane a mesh of triangles was drawn in.
template <int Dim>
std::array<double, Dim> coordinates_of(const Point& x) {
  if constexpr (Dim == 3)
    return x;
  else
    return {x[0], x[1] + x[2]};
}

/// Finds cells of the mesh by the places of their vertices, which a run keeps to the last bit, though not their
/// numbers.
template <int Dim, int Order>
class CellFinder {
 public:
  explicit CellFinder(const SimplexMesh<Dim, Order>& mesh) {
    for (const auto& cell : mesh.cells)
      for (int i = 0; i <= Dim; ++i) vertex_.try_emplace(coordinates_of<Dim>(mesh.nodes[cell[i]]), cell[i]);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      Key key;
      for (int i = 0; i <= Dim; ++i) key[i] = vertex_.at(coordinates_of<Dim>(mesh.nodes[mesh.cells[c][i]]));
      std::sort(key.begin(), key.end());
      cell_[key] = static_cast<int>(c);
    }
  }
  /// -1: there is none. \param corners  places of its vertices
  int find(const std::array<Point, Dim + 1>& corners) const {
    Key key;
    for (int i = 0; i <= Dim; ++i) {
      const auto found = vertex_.find(coordinates_of<Dim>(corners[i]));
      if (found == vertex_.end()) return -1;
      key[i] = found->second;
    }
    std::sort(key.begin(), key.end());
    const auto found = cell_.find(key);
    return found == cell_.end() ? -1 : found->second;
  }

 private:
  using Key = std::array<int, Dim + 1>;
  std::map<std::array<double, Dim>, int> vertex_;
  std::unordered_map<Key, int, FacetKeyHash> cell_;
};

/// The cells of the mesh that a grid of the run has.
template <int Dim, int Order>
std::vector<int> cells_of_grid(const CellFinder<Dim, Order>& finder, const LastFields& run) {
  const auto& grid = run.grid;
  const auto refuse = [&](const std::string& problem) {
    throw InputError(run.file.string(), grid.name, problem, "give the mesh that the run's case names");
  };
  const bool quadratic = grid.nodes_per_cell == nodes_of_simplex(Dim, 2);
  if (grid.nodes_per_cell != Dim + 1 && !quadratic) refuse("is the grid of a mesh of another dimension");
  std::vector<int> found;
  for (std::size_t first = 0; first < grid.cells.size(); first += static_cast<std::size_t>(grid.nodes_per_cell)) {
    std::array<Point, Dim + 1> corners;
    for (int i = 0; i <= Dim; ++i) corners[i] = grid.points[grid.cells[first + i]];
    found.push_back(finder.find(corners));
    if (found.back() < 0)
      refuse(fmt::format("has a cell at ({:.6g}, {:.6g}, {:.6g}) mm that the mesh does not have", corners[0][0],
                         corners[0][1], corners[0][2]));
  }
  return found;
}

template <int Dim, int Order>
double measure_of(const SimplexMesh<Dim, Order>& mesh, int cell) {
  std::array<Point, Dim + 1> x;
  for (int i = 0; i <= Dim; ++i) x[i] = mesh.nodes[mesh.cells[cell][i]];
  return simplex_volume<Dim>(x.data());
}

/// Adds a field's shares. \returns whether it is anything but zero
template <int Dim, int Order>
bool add_shares(const SimplexMesh<Dim, Order>& mesh, const std::vector<int>& cells, const std::vector<double>& eta,
                std::vector<double>& shares) {
  std::vector<double> squares(cells.size());
  double sum = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) sum += squares[c] = measure_of(mesh, cells[c]) * eta[c] * eta[c];
  if (!(sum > 0)) return false;
  for (std::size_t c = 0; c < cells.size(); ++c) shares[cells[c]] += squares[c] / sum;
  return true;
}

template <int Dim, int Order>
ErrorShares shares_on(const SimplexMesh<Dim, Order>& mesh, const std::filesystem::path& run,
                      std::vector<std::string> quantities) {
  if (quantities.empty()) quantities = {"velocity", "displacement", "pressure"};
  std::vector<std::string> names;
  for (const auto& quantity : quantities) names.insert(names.end(), {quantity + "_error_mean", quantity + "_error"});
  const CellFinder<Dim, Order> finder(mesh);
  ErrorShares result;
  result.shares.assign(mesh.cells.size(), 0.0);
  for (const auto& found : last_fields_of_cells(run, names)) {
    const auto cells = cells_of_grid(finder, found);
    for (const auto& quantity : quantities) {
      auto field = found.values.find(quantity + "_error_mean");
      if (field == found.values.end()) field = found.values.find(quantity + "_error");
      if (field == found.values.end() || !add_shares(mesh, cells, field->second, result.shares)) continue;
      result.fields.push_back(found.grid.name + "." + field->first);
      if (quantity == "pressure" || found.grid.nodes_per_cell == Dim + 1) result.order = 2;
    }
  }
  if (result.fields.empty())
    throw InputError(run.string(), fmt::format("{}", fmt::join(names, ", ")), "are not among its fields, or zero",
                     "run the case with --set output.error_indicator=true first");
  for (double& share : result.shares) share /= static_cast<double>(result.fields.size());
  return result;
}

}  // namespace

ErrorShares read_error_shares(const AnyMesh& mesh, const std::filesystem::path& run,
                              const std::vector<std::string>& quantities) {
  return std::visit([&](const auto& of_file) { return shares_on(of_file, run, quantities); }, mesh);
}

}  // namespace fsi
