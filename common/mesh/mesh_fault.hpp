#pragma once

#include <string>

namespace fsi {

/// A reason why drivers refuse a mesh, for callers that collect all of them.
struct MeshFault {
  enum class Kind {
    unused_nodes,
    inverted_cells,
    flat_cells,
    folded_curved_cells,
    repeated_cells,
    volumes,
    doubled_nodes,
    folded_facets,  ///< more than two cells at a facet, or both on one side of it
    surfaces,
    fluid_in_pieces,
    loose_wall,
    interface,
  };
  Kind kind;
  std::string text;  ///< `FILE: KEY: PROBLEM; REMEDY`, as the error of a driver says it
};

}  // namespace fsi
