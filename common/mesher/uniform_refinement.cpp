#include "mesher/uniform_refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "host/available_memory.hpp"
#include "mesh/cell_words.hpp"
#include "mesh/facet_uses.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/mid_edge_nodes.hpp"
#include "mesh/mirror.hpp"
#include "mesh/point_math.hpp"
#include "mesher/child_cells.hpp"

namespace fsi {

namespace {

/// Children of a simplex by their vertices: 0 .. Dim are its own, Dim + 1 + e is the middle of its edge e.
template <int Dim>
struct Children;
template <>
struct Children<1> {
  static constexpr std::array<std::array<int, 2>, 2> vertices{{{0, 2}, {2, 1}}};
};
template <>
struct Children<2> {
  static constexpr std::array<std::array<int, 3>, 4> vertices{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {4, 5, 3}}};
};
/// [Bey1995], algorithm "RefineTetrahedron3D"; the diagonal is that between the middles of the edges 02 and 13.
/// Children keep this order of their vertices, which turns some of them inside out, until they are finished.
template <>
struct Children<3> {
  static constexpr std::array<std::array<int, 4>, 8> vertices{
      {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}, {4, 6, 7, 8}, {4, 6, 5, 8}, {6, 7, 8, 9}, {6, 5, 8, 9}}};
};

/// +1 or -1 per child: whether it has its parent's orientation.
template <int Dim>
std::array<int, 1 << Dim> orientations() {
  std::array<Point, nodes_of_simplex(Dim, 2)> x{};
  for (int i = 1; i <= Dim; ++i) x[i][i - 1] = 1;
  for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
    const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
    x[Dim + 1 + e] = 0.5 * (x[a] + x[b]);
  }
  std::array<int, 1 << Dim> signs;
  for (std::size_t child = 0; child < signs.size(); ++child) {
    std::array<Point, Dim + 1> corners;
    for (int i = 0; i <= Dim; ++i) corners[i] = x[Children<Dim>::vertices[child][i]];
    signs[child] = simplex_volume<Dim>(corners.data()) > 0 ? 1 : -1;
  }
  return signs;
}

/// The numbers of vertices, edges, faces (in three dimensions) and cells.
struct Counts {
  double vertices, edges, faces, cells;
};

template <int Dim, int Order>
Counts counts_of(const SimplexMesh<Dim, Order>& mesh) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(mesh.cells.size() * SimplexEdges<Dim>::vertices.size());
  std::vector<char> is_vertex(mesh.nodes.size(), 0);
  for (const auto& cell : mesh.cells) {
    for (int i = 0; i <= Dim; ++i) is_vertex[cell[i]] = 1;
    for (const auto& [a, b] : SimplexEdges<Dim>::vertices)
      edges.push_back({std::min(cell[a], cell[b]), std::max(cell[a], cell[b])});
  }
  std::sort(edges.begin(), edges.end());
  Counts counts{};
  counts.vertices = static_cast<double>(std::count(is_vertex.begin(), is_vertex.end(), 1));
  counts.edges = static_cast<double>(std::unique(edges.begin(), edges.end()) - edges.begin());
  counts.cells = static_cast<double>(mesh.cells.size());
  if constexpr (Dim == 3) {
    const auto uses = sorted_facet_uses(mesh);
    for (std::size_t f = 0; f < uses.size(); ++f) counts.faces += f == 0 || uses[f].key != uses[f - 1].key ? 1 : 0;
  }
  return counts;
}

template <int Dim>
Counts refined(const Counts& c) {
  if constexpr (Dim == 3)
    return {c.vertices + c.edges, 2 * c.edges + 3 * c.faces + c.cells, 4 * c.faces + 8 * c.cells, 8 * c.cells};
  else
    return {c.vertices + c.edges, 2 * c.edges + 3 * c.cells, 0, 4 * c.cells};
}

/// Bytes per cell that making, writing and reading again takes, of which the model of the gmsh library is the largest
/// part. Measured as peak memory: 220 per straight tetrahedron, 250 per triangle; 650 and 550 where they are quadratic.
constexpr double bytes_per_cell(int order) {
  return order == 1 ? 300 : 800;
}

/// A mesh that is cut repeatedly.
template <int Dim, int Order>
class Refinement {
  using Mesh = SimplexMesh<Dim, Order>;
  using Cell = typename Mesh::Cell;
  static constexpr int children = 1 << Dim;

 public:
  Refinement(const Mesh& mesh, std::string file) : file_(std::move(file)), mesh_(mesh), sign_(mesh.cells.size(), 1) {
    if constexpr (Dim == 3) cut_along_shortest_diagonals();
  }

  void cut() {
    make_vertices();
    std::vector<Cell> cells;
    std::vector<signed char> signs;
    cells.reserve(children * mesh_.cells.size());
    signs.reserve(children * mesh_.cells.size());
    static const auto orientation = orientations<Dim>();
    EdgeMiddles next_middles;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const auto parts = with_middles<Dim>(mesh_.cells[c]);
      for (int child = 0; child < children; ++child) {
        cells.push_back(part_of_cell(parts, Children<Dim>::vertices[child], next_middles));
        signs.push_back(static_cast<signed char>(sign_[c] * orientation[child]));
      }
    }
    cut_facets(next_middles);
    std::vector<int> regions;
    regions.reserve(cells.size());
    for (const int region : mesh_.cell_region) regions.insert(regions.end(), children, region);
    mesh_.cells = std::move(cells);
    mesh_.cell_region = std::move(regions);
    sign_ = std::move(signs);
    require_all_upright();
  }

  Mesh finish() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      if (sign_[c] < 0) mesh_.cells[c] = reversed<Dim>(mesh_.cells[c]);
    return std::move(mesh_);
  }

 private:
  /// Orders vertices such that the shortest diagonal is the one that `Children` cuts along.
  void cut_along_shortest_diagonals() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      auto& cell = mesh_.cells[c];
      const auto middle = [&](int e) {
        if constexpr (Order == 2) return mesh_.nodes[cell[4 + e]];
        const auto& [a, b] = SimplexEdges<3>::vertices[e];
        return 0.5 * (mesh_.nodes[cell[a]] + mesh_.nodes[cell[b]]);
      };
      const double d01 = distance(middle(0), middle(5)), d12 = distance(middle(1), middle(3)),
                   d02 = distance(middle(2), middle(4));
      if (d02 <= d01 && d02 <= d12) continue;
      sign_[c] = -1;
      // Vertices 0 and 1 exchanged: edges 12 and 03 become 02 and 13. Exchanged 1 and 2 instead, 01 and 23 do.
      if (d12 <= d01)
        cell = reversed<3>(cell);
      else
        exchange_middle_vertices(cell);
    }
  }
  static void exchange_middle_vertices(Cell& cell) {
    std::swap(cell[1], cell[2]);
    if constexpr (Order == 2) {
      std::swap(cell[4], cell[6]);  // edges 01 and 02
      std::swap(cell[8], cell[9]);  // 13 and 23
    }
  }

  /// The simplex's vertices and the middles of its edges.
  template <int SimplexDim, std::size_t Nodes>
  std::array<int, nodes_of_simplex(SimplexDim, 2)> with_middles(const std::array<int, Nodes>& simplex) const {
    std::array<int, nodes_of_simplex(SimplexDim, 2)> all;
    std::copy(simplex.begin(), simplex.end(), all.begin());
    if constexpr (Order == 1)
      for (std::size_t e = 0; e < SimplexEdges<SimplexDim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<SimplexDim>::vertices[e];
        all[SimplexDim + 1 + e] = middles_.at(simplex[a], simplex[b]);
      }
    return all;
  }

  /// Middles of the edges of straight cells; quadratic ones have them.
  void make_vertices() {
    if constexpr (Order == 1) {
      middles_ = {};
      for (const auto& cell : mesh_.cells)
        for (const auto& [a, b] : SimplexEdges<Dim>::vertices)
          if (middles_.find_or_add(cell[a], cell[b], static_cast<int>(mesh_.nodes.size())).second)
            mesh_.nodes.push_back(0.5 * (mesh_.nodes[cell[a]] + mesh_.nodes[cell[b]]));
    }
  }

  /// A child with its vertices, and the nodes in the middles of its edges, which are made where they are new.
  Cell part_of_cell(const std::array<int, nodes_of_simplex(Dim, 2)>& parent, const std::array<int, Dim + 1>& vertices,
                    EdgeMiddles& middles) {
    Cell child;
    for (int i = 0; i <= Dim; ++i) child[i] = parent[vertices[i]];
    if constexpr (Order == 2)
      for (std::size_t e = 0; e < SimplexEdges<Dim>::vertices.size(); ++e) {
        const auto& [a, b] = SimplexEdges<Dim>::vertices[e];
        const auto [node, is_new] = middles.find_or_add(child[a], child[b], static_cast<int>(mesh_.nodes.size()));
        child[Dim + 1 + e] = node;
        if (!is_new) continue;
        mesh_.nodes.push_back(point_between<Dim>(mesh_.nodes, parent, vertices[a], vertices[b]));
      }
    return child;
  }

  void cut_facets(const EdgeMiddles& next_middles) {
    for (auto& group : mesh_.facet_groups) {
      std::vector<typename Mesh::Facet> facets;
      facets.reserve((children / 2) * group.facets.size());
      for (const auto& facet : group.facets) {
        const auto parts = with_middles<Dim - 1>(facet);
        for (const auto& vertices : Children<Dim - 1>::vertices) {
          auto& child = facets.emplace_back();
          for (int i = 0; i < Dim; ++i) child[i] = parts[vertices[i]];
          if constexpr (Order == 2)
            for (std::size_t e = 0; e < SimplexEdges<Dim - 1>::vertices.size(); ++e) {
              const auto& [a, b] = SimplexEdges<Dim - 1>::vertices[e];
              child[Dim + e] = next_middles.at(child[a], child[b]);
            }
        }
      }
      group.facets = std::move(facets);
    }
  }

  void require_all_upright() const {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      require_upright<Dim, Order>(mesh_.nodes, mesh_.cells[c], sign_[c], file_);
  }

  std::string file_;
  Mesh mesh_;
  std::vector<signed char> sign_;  ///< of the cells' volumes while their vertices stand in the order of `Children`
  EdgeMiddles middles_;
};

}  // namespace

template <int Dim, int Order>
RefinedCounts refined_counts(const SimplexMesh<Dim, Order>& mesh, int times) {
  auto counts = counts_of(mesh);
  for (int i = 0; i < times; ++i) counts = refined<Dim>(counts);
  return {counts.vertices + (Order == 2 ? counts.edges : 0), counts.cells};
}

template <int Dim, int Order>
SimplexMesh<Dim, Order> refine_uniformly(const SimplexMesh<Dim, Order>& mesh, int times, const std::string& file) {
  const auto counts = refined_counts(mesh, times);
  const auto text = fmt::format("{:.0f} nodes, {:.0f} {}", counts.nodes, counts.cells, CellWords<Dim>::cells);
  if (std::max(counts.nodes, counts.cells) > std::numeric_limits<int>::max())
    throw InputError(file, "--times", fmt::format("the mesh would have {}, more than can be numbered", text),
                     "refine less often");
  const double bytes = bytes_per_cell(Order) * counts.cells;
  if (const auto room = available_memory(); bytes > static_cast<double>(room.bytes))
    throw OutOfMemory(fmt::format("a mesh of {} takes some {}", text, memory_text(bytes)), "refine less often");
  Refinement<Dim, Order> refinement(mesh, file);
  for (int i = 0; i < times; ++i) refinement.cut();
  return refinement.finish();
}

#define INSTANTIATE(Dim, Order)                                               \
  template RefinedCounts refined_counts(const SimplexMesh<Dim, Order>&, int); \
  template SimplexMesh<Dim, Order> refine_uniformly(const SimplexMesh<Dim, Order>&, int, const std::string&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE

}  // namespace fsi
