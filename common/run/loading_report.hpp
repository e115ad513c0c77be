#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/run_log.hpp"
#include "run/console.hpp"
#include "run/load_scene.hpp"

namespace fsi {

/// What is said while a scene is loaded, when there is no result folder yet: shown at once, and kept for the log.
class LoadingReport {
 public:
  /// \param quiet  shows warnings only
  LoadingReport(std::string program, bool quiet);

  /// A follower for load_scene(), to which this must stay. \param mesh_known  as there
  LoadingScene follower(std::function<void(std::size_t cells)> mesh_known = {});

  /// Nothing more is shown: others may write to the terminal from a fresh line on.
  void end() { console_.reset(); }

  /// All that was said, into a log that has begun meanwhile.
  void write_to(RunLog& log) const;

 private:
  std::string program_;
  std::unique_ptr<Console> console_;
  std::vector<std::string> warnings_, lines_;
};

}  // namespace fsi
