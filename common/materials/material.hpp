#pragma once

#include <variant>

#include "materials/artery.hpp"
#include "materials/mooney_rivlin.hpp"
#include "materials/neo_hookean.hpp"

namespace fsi {

/// One wall layer's material. A new material is a file beside these, an entry here and one in the case reader's table.
using Material = std::variant<NeoHookean, MooneyRivlin, Artery>;

}  // namespace fsi
