// fsi-linear-study: single Newton systems of a case, each solved by several linear solvers.
#include "base/error.hpp"
#include "case/case_reader.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "io/hdf5_library.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "monolithic/study/linear_study.hpp"
#include "parallel/communicator.hpp"
#include "run/interruption.hpp"
#include "run/program.hpp"

int main(int argc, char** argv) {
  using namespace fsi;
  const std::string program = linear_study_program;
  guard_standard_streams();
  wait_briefly(argv);
  end_at_signals(program, "before the end; nothing has been written");
  return run_program(program, [&]() -> int {
    begin_hdf5();
    const ProcessGroup group;
    keep_streams_silent(!Communicator::world().is_first());
    if (!Communicator::world().is_alone())
      throw InputError("mpirun", program, "works on one process", "start the program by itself");
    LinearStudyRequest study;
    const auto line = parse_command_line(program, "Solves Newton systems of a case by several linear solvers.", argc,
                                         argv, study.options());
    if (!line) return exit_done;
    set_threads(line->threads);
    const Case setup = read_case(line->case_file, line->overrides);
    set_petsc_options(setup.petsc.options, setup.path.string());
    for (const auto& warning : setup.warnings) warn(program, warning);
    return study.run(*line, setup);
  });
}
