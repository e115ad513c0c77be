#pragma once

#include <string>

namespace fsi::test {

// Valid cases that the tests bend out of shape..

inline const std::string coupled_case = R"(title = "a coupled case"
element = "p1"
[mesh]
level = "coarse"
[fluid]
density = 1.0
viscosity = 3.5e-3
[structure]
density = 1.2
bulk_modulus = 1e5
[structure.layers.media]
material = "artery"
c10 = 3.0
k1 = 2.3632
k2 = 0.8393
alpha = 29.0
[structure.layers.adventitia]
material = "mooney-rivlin"
c10 = 0.3
c01 = 0.2
[inlet]
pressure = 1.332
until = 0.125
[time]
step = 0.125
end = 12.0
[monolithic]
linear_solver = "direct"
multigrid.levels = 10
[partitioned]
scheme = "aitken"
tolerance = 1e-6
[output]
fields = ["displacement", "velocity", "pressure"]
every = 8
)";

inline const std::string fluid_case = R"(title = "a fluid between rigid walls"
[mesh]
file = "tube.msh"
[fluid]
density = 1.0
viscosity = 3.5e-3
[inlet]
pressure = [[0, 0], [1, 2.5], [1, 0], [3, 1]]
[time]
step = 0.1
end = 3
)";

inline const std::string static_case = R"(title = "a wall under pressure"
[mesh]
file = "tube.msh"
[structure]
density = 1.2
bulk_modulus = 1e5
[structure.layers.wall]
material = "neo-hookean"
c10 = 3
[load]
pressure = 2.0
[static]
load_steps = 5
)";

/// `text` with its first `from` replaced by `to`; text that is not there is a mistake in the test.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace fsi::test
