#include "mesh/overlap.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/cell_grid.hpp"
#include "mesh/for_each_mesh.hpp"

namespace fsi {

namespace {

constexpr double inside = 1e-3, towards_middle = 0.1;

template <int Dim>
bool has_volume(const Point* x) {
  double longest = 0;
  for (int a = 0; a <= Dim; ++a)
    for (int b = 0; b < a; ++b) longest = std::max(longest, distance(x[a], x[b]));
  if constexpr (Dim == 3)
    return tetrahedron_volume(x[0], x[1], x[2], x[3]) > 1e-9 * longest * longest * longest;
  else
    return triangle_area(x[0], x[1], x[2]) > 1e-9 * longest * longest;
}

}  // namespace

template <int Dim, int Order>
std::vector<Overlap> overlaps(const SimplexMesh<Dim, Order>& mesh) {
  std::vector<int> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (has_volume<Dim>(map_of(mesh, static_cast<int>(c)).x.data())) cells.push_back(static_cast<int>(c));
  if (cells.empty()) return {};
  const CellGrid grid(mesh, cells);
  using Barycentric = typename CellMap<Dim, Order>::Barycentric;
  std::map<std::pair<int, int>, Overlap> found;
  for (const int c : cells) {
    const auto map = map_of(mesh, c);
    int other = -1;
    Point place{};
    for (int a = 0; a <= Dim && other < 0; ++a) {
      Barycentric here;
      here.fill(towards_middle / (Dim + 1));
      here[a] += 1 - towards_middle;
      place = map.at(here);
      const auto [begin, end] = grid.near(place);
      const auto holds = [&](int cell) {
        Barycentric l;
        return cell != c && map_of(mesh, cell).find(place, l) && *std::min_element(l.begin(), l.end()) >= inside;
      };
      if (const auto* first = std::find_if(begin, end, holds); first != end) other = *first;
    }
    if (other < 0) continue;
    const int of = mesh.cell_region[c], within = mesh.cell_region[other];
    auto& entry = found.try_emplace({of, within}, Overlap{of, within}).first->second;
    if (entry.cells++ == 0) entry.first = place;
  }
  std::vector<Overlap> list;
  for (const auto& [key, entry] : found) list.push_back(entry);
  return list;
}

#define INSTANTIATE(Dim, Order) template std::vector<Overlap> overlaps(const SimplexMesh<Dim, Order>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
