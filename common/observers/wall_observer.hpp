#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// Extreme deformations of the wall's layers (wall/wall_deformation.hpp), for the summary, and a warning where those of
/// `linear-elastic` layers are not small. Null where there is no wall.
template <int n>
std::unique_ptr<Observer> make_wall_observer(const RunView<n>& watched);

}  // namespace fsi
