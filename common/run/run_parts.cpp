#include "run/run_parts.hpp"

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "fem/dimensions.hpp"
#include "host/available_memory.hpp"
#include "host/threads.hpp"
#include "scene/time_scheme.hpp"

namespace fsi {

namespace {

ThreadChoice set_as_chosen(const ThreadChoice& choice) {
  set_threads(choice.count);
  return choice;
}

/// \throws InputError where a scene is not shared out by all processes
template <int n>
const Communicator& shared_by_all(const Scene<n>& scene) {
  if (scene.processes().size() == Communicator::world().size()) return scene.processes();
  throw InputError("mpirun", "", "this scene works on one process", "start the program by itself");
}

/// The case with what the scene has decided in its place.
template <int n>
Case as_computed(Case setup, const Scene<n>& scene) {
  if (setup.structure && scene.fibre_frame) setup.structure->fibre_frame = scene.fibre_frame;
  return setup;
}

/// Cells with a mean of the error indicator.
template <int n>
CellShare cells_of(const MediumErrors<n>& medium) {
  if (!medium.mean) return {};
  return {medium.indicator->cells(), medium.indicator->order()};
}

}  // namespace

template <int n>
RunParts<n>::RunParts(const std::string& named, const CommandLine& of_line, const Case& of_case,
                      const StepperMaker& make_stepper, const CoreWatch& watch,
                      const std::optional<FolderLock>& of_folder)
    : program(named),
      line(of_line),
      lock(of_folder),
      setup(of_case),
      loading(program, line.quiet),
      loaded(load_scene<n>(setup, loading.follower([&](std::size_t cells) {
        threads = set_as_chosen(threads_of_process(line.threads, cells, watch, Communicator::world()));
      }))),
      scene(*loaded.scene),
      case_hash(hash_of_case(as_computed(setup, scene))),
      case_text(readable_dump(as_computed(setup, scene))),
      processes(shared_by_all(scene)),
      first(processes),
      about_processes(scene),
      work_unit(scene),
      orders(scene, loaded.derived.statistics ? &loaded.derived.shear->nodes() : nullptr,
             cells_of(loaded.derived.fluid_errors), cells_of(loaded.derived.wall_errors)),
      loads(setup),
      stepper(make_stepper.make(scene, loads, setup)),
      march(
          setup, scene, *stepper, loads, [this](const std::string& said) { messages.log_only(said); },
          [this](const std::string& said) { messages.warn(said); }),
      state(scene.at_rest()) {
  set_memory_notices([this](const std::string& said) { messages.log_only(said); });
  if (scene.is_static()) return;
  scheme = time_scheme_of(setup, scene);
  require_resolvable(setup, scene);
}

template <int n>
RunParts<n>::~RunParts() {
  set_memory_notices({});
}

template <int n>
const State& RunParts<n>::level_before(const State& at) {
  shown_.step = at.step - 1;
  shown_.time = at.times[1];
  shown_.now = at.before[1];
  shown_.wall_velocity = at.wall_velocity_before;
  return shown_;
}

template <int n>
void RunParts<n>::keep_scheme(const std::string& kept) {
  scheme = kept;
  scene.integrator = make_time_scheme(setup, scene, scheme);
  state = scene.at_rest();
  march.keep_scheme();
}

#define FSI_INSTANTIATE(n) template struct RunParts<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
