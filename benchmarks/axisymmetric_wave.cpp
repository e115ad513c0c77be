// axisymmetric_wave MATERIAL REFINEMENT FILE.csv [STEP ALPHA WALL.csv]: the artery as a body of revolution, centre-line
// pressure as the drivers write it; with a time step in ms and a stabilisation factor of the wall, its displacement
// too. The reference of docs/results.md for the error of the mesh and, by scripts/reference_waves.py, of the
// accuracy-cost study. It shares the weak forms.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "base/threads.hpp"
#include "support/axisymmetric_artery.hpp"

int main(int argc, char** argv) {
  if (argc != 4 && argc != 7) {
    fmt::print(stderr, "usage: axisymmetric_wave MATERIAL REFINEMENT FILE.csv [STEP ALPHA WALL.csv]\n");
    return 1;
  }
  fsi::set_threads(1);
  const bool more = argc == 7;
  fsi::testing::AxisymmetricArtery artery(argv[1], std::atoi(argv[2]), more ? std::atof(argv[4]) : 0.125,
                                          more ? std::atof(argv[5]) : 0.5);
  std::ofstream file(argv[3]), wall;
  file << "time_ms,z_mm,pressure_Pa\n";
  if (more) {
    wall.open(argv[6]);
    wall << "time_ms,z_mm,radial_mm\n";
  }
  while (artery.time() < 12 - 1e-9) {
    artery.step();
    const auto p = artery.centre_line();
    for (std::size_t i = 0; i < p.size(); ++i)
      file << fmt::format("{},{},{}\n", artery.time(), static_cast<double>(i) / 10, p[i]);
    if (!more) continue;
    const auto r = artery.inner_wall();
    for (std::size_t i = 0; i < r.size(); ++i)
      wall << fmt::format("{},{},{}\n", artery.time(), static_cast<double>(i) / 10, r[i]);
  }
  fmt::print("{} unknowns\n", artery.unknowns());
  return file.good() && wall.good() ? 0 : 1;
}
