#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "scene/scene.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// The cells of a medium here that a checkpoint has numbers of, and how processes share them out.
struct CellShare {
  std::size_t cells = 0;
  const WholeOrder* order = nullptr;  ///< null: all are here
};

/// How processes share out the arrays of a scene's checkpoint, and how long each is here, by its ArrayKind. Made by all
/// processes together.
template <int n>
class ArrayOrders {
 public:
  /// \param shear_nodes  of the fluid, with wall shear stress; null: there are none
  /// \param fluid, wall  cells with numbers of their own. All that the parameters refer to must outlive this
  explicit ArrayOrders(const Scene<n>& scene, const std::vector<int>* shear_nodes = nullptr, CellShare fluid = {},
                       CellShare wall = {});

  const Communicator& processes() const { return scene_.processes(); }
  /// None for what all processes have alike, and for all on one process.
  std::optional<SharedArray> of(ArrayKind kind) const;
  /// By the names of arrays, while this and `kinds` live. One without kind is alike.
  ArraySharing sharing(const std::map<std::string, ArrayKind>& kinds) const;
  /// Numbers here; of interface_columns those of one column. Empty for `alike`: any number.
  /// \param rest  the state at rest, for the sizes
  std::optional<std::size_t> length(ArrayKind kind, const State& rest) const;

 private:
  const Scene<n>& scene_;
  std::size_t shear_nodes_;
  CellShare fluid_cells_, wall_cells_;
  std::optional<WholeOrder> fluid_, wall_, interface_, shear_, branches_;
};

}  // namespace fsi
