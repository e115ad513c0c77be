#pragma once

#include <memory>

#include "observers/run_view.hpp"

namespace fsi {

/// How far the wall's layers are deformed (wall/wall_deformation.hpp), for the summary, and a warning where
/// `linear-elastic` ones leave small strains behind. Null where there is no wall.
template <int n>
std::unique_ptr<Observer> make_wall_observer(const RunView<n>& watched);

}  // namespace fsi
