#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fsi {

/// A subcommand of fsi-mesh.
struct MeshCommand {
  CLI::App* options;          ///< its part of the command line, parsed when it was asked for
  std::function<void()> run;  ///< makes and writes the mesh
};

}  // namespace fsi
