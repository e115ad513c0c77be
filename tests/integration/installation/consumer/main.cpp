// Uses one library that knows a mesh, one that hides TOML and one that hides UMFPACK.
#include <iostream>

#include "base/version.hpp"
#include "case/case_reader.hpp"
#include "linear/direct/direct_solver.hpp"
#include "mesher/artery_generator.hpp"

int main(int, char** arguments) {
  const fsi::TetrahedralMesh mesh = fsi::generate_artery(fsi::artery_level("coarse"));
  const fsi::Case data = fsi::read_case(arguments[1]);
  const fsi::DirectSolver solver;
  std::cout << fsi::version << ' ' << mesh.nodes.size() << ' ' << data.title << ' ' << solver.factorised() << '\n';
}
