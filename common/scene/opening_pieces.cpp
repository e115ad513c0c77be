#include "scene/opening_pieces.hpp"

#include <fmt/format.h>

#include "case/openings.hpp"
#include "mesh/for_each_mesh.hpp"
#include "mesh/surface_pieces.hpp"

namespace fsi {

namespace {

/// What takes all pieces of an opening together; empty: each piece has the same pressure, as it would alone.
std::string takes_all(const OpeningData& opening) {
  if (opening.flow_rate) return "its flow_rate is shared out among all of them, along their mean normal";
  if (opening.law)
    return fmt::format("its {} takes the flow of all of them, and gives all one pressure", opening.law->name);
  if (opening.joined) return "the network takes the flow of all of them, and gives all one pressure";
  return "";
}

}  // namespace

template <int Dim, int Order>
void note_opening_pieces(const Case& setup, const SimplexMesh<Dim, Order>& mesh, std::vector<std::string>& notices,
                         std::vector<std::string>& remarks) {
  for (const auto& opening : openings_of(setup)) {
    const auto* facets = mesh.facets(opening.surface);
    if (facets == nullptr) continue;
    const SurfacePieces found = pieces_of<Dim>(mesh.nodes, *facets);
    if (found.whole()) continue;
    const std::string together = takes_all(opening);
    std::string text =
        fmt::format("{}: opening.{}: the surface {}", setup.path.string(), opening.surface, said_of<Dim>(found));
    if (found.pieces.size() > 1)
      text +=
          "; " + (together.empty() ? std::string("tables show the flow and mean pressure of all of them") : together);
    if (found.leaning.empty() && together.empty()) {
      remarks.push_back(std::move(text));
      continue;
    }
    if (!found.leaning.empty())
      text += fmt::format("; leave out of the group what is no part of the opening{}",
                          found.pieces.size() > 1 ? ", and give" : "");
    else
      text += "; give";
    if (found.pieces.size() > 1)
      text += fmt::format(" each opening a surface and an [[opening]] of its own{}",
                          found.leaning.empty() ? ", unless this is meant" : "");
    notices.push_back(std::move(text));
  }
}

// Numbers as template arguments: parentheses would only hide them.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define INSTANTIATE(Dim, Order)                                                                             \
  template void note_opening_pieces(const Case&, const SimplexMesh<Dim, Order>&, std::vector<std::string>&, \
                                    std::vector<std::string>&);
FSI_FOR_EACH_MESH(INSTANTIATE)
#undef INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fsi
