// axisymmetric_wave MATERIAL REFINEMENT FILE.csv: the artery as a body of revolution, centre-line pressure as the
// drivers write it. The independent reference of docs/results.md.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>

#include "base/threads.hpp"
#include "support/axisymmetric_artery.hpp"

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: axisymmetric_wave MATERIAL REFINEMENT FILE.csv\n");
    return 1;
  }
  fsi::set_threads(1);
  fsi::testing::AxisymmetricArtery artery(argv[1], std::atoi(argv[2]));
  std::ofstream file(argv[3]);
  file << "time_ms,z_mm,pressure_Pa\n";
  while (artery.time() < 12 - 1e-9) {
    artery.step();
    const auto p = artery.centre_line();
    for (std::size_t i = 0; i < p.size(); ++i)
      file << fmt::format("{},{},{}\n", artery.time(), static_cast<double>(i) / 10, p[i]);
  }
  fmt::print("{} unknowns\n", artery.unknowns());
  return file.good() ? 0 : 1;
}
