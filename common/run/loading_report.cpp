#include "run/loading_report.hpp"

#include <utility>

#include "parallel/communicator.hpp"
#include "run/program.hpp"

namespace fsi {

LoadingReport::LoadingReport(std::string program, bool quiet)
    : program_(std::move(program)),
      console_(std::make_unique<Console>(0, Console::style_for(quiet || !Communicator::world().is_first()))) {}

LoadingScene LoadingReport::follower(std::function<void(std::size_t cells)> mesh_known) {
  LoadingScene loading;
  loading.mesh_known = std::move(mesh_known);
  loading.mesh_strange = [this](const std::string& said) {
    warn(program_, said);
    warnings_.push_back(said);
  };
  loading.prestress_goes_on = [this](const std::string& said) {
    if (console_) console_->progress(said);
    lines_.push_back(said);
  };
  return loading;
}

void LoadingReport::write_to(RunLog& log) const {
  for (const auto& said : warnings_) log.warning(said);
  for (const auto& said : lines_) log.info(said);
}

}  // namespace fsi
