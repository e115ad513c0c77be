#include "run/driver.hpp"

#include <optional>

#include "base/error.hpp"
#include "case/case_reader.hpp"
#include "host/available_memory.hpp"
#include "host/idle_cores.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "io/first_process.hpp"
#include "io/folder_lock.hpp"
#include "io/hdf5_library.hpp"
#include "io/write_error.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "run/check.hpp"
#include "run/interruption.hpp"
#include "run/load_scene.hpp"
#include "run/program.hpp"
#include "run/result_place.hpp"
#include "run/run.hpp"

namespace fsi {

int run_driver(const std::string& program, const std::string& description, int argc, const char* const* argv,
               const StepperMaker& make_stepper) {
  guard_standard_streams();
  wait_briefly(argv);
  end_at_signals(program, "before the first step; nothing is lost by starting again");
  std::optional<ProcessGroup> group;  // to the last words
  return run_program(program, [&] {
    const CoreWatch watch;
    begin_hdf5();
    group.emplace();
    const Communicator& processes = Communicator::world();
    keep_streams_silent(!processes.is_first());
    if (!processes.is_alone()) expect_launcher();
    auto line = parse_command_line(program, description, argc, argv);
    if (!line) return static_cast<int>(exit_done);
    line->processes = processes.size();
    set_threads(line->threads);  // a run chooses anew
    const Case setup = read_case(line->case_file, line->overrides);
    set_petsc_options(setup.petsc.options, setup.path.string());
    for (const auto& warning : setup.warnings) warn(program, warning);
    if (line->check) {
      const Activity activity("looking at what a run would be");
      return components_of(setup) == 2 ? check_case<2>(program, *line, setup, make_stepper, watch)
                                       : check_case<3>(program, *line, setup, make_stepper, watch);
    }
    std::optional<FolderLock> lock;
    at_first(processes, [&] {
      require_no_run_in_source(*line);
      require_no_run_in(line->output, "wait for its end, or give -o another folder");
      require_folder(*line);
      lock.emplace(line->output, program);
      if (!lock->said().empty()) warn(program, lock->said());
      require_folder(*line);  // again: a run may have ended in it meanwhile
    });
    const Activity activity("reading the mesh and building the scene");
    try {
      return components_of(setup) == 2 ? run_case<2>(program, *line, setup, make_stepper, watch, lock)
                                       : run_case<3>(program, *line, setup, make_stepper, watch, lock);
    } catch (const WriteError& failure) {
      throw failure.then(way_on(*line));
    }
  });
}

}  // namespace fsi
