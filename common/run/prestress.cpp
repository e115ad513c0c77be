#include "run/prestress.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "case/case_hash.hpp"
#include "case/case_keys.hpp"
#include "case/support_loads.hpp"
#include "fem/dimensions.hpp"
#include "linear/choice/general_solvers.hpp"
#include "restart/array_orders.hpp"
#include "system/prestress.hpp"

namespace fsi {

namespace {

constexpr const char* kind = "prestress";  // of file: stands where a checkpoint names its program
constexpr const char* displacement_name = "displacement";
constexpr const char* wall_name = "wall";

std::map<std::string, ArrayKind> kinds_of_arrays() {
  return {{displacement_name, ArrayKind::wall_vectors}, {wall_name, ArrayKind::wall}};
}

/// The entries of a case that a prestress depends on, a line each.
template <int n>
std::string wall_text(const Case& setup, const Scene<n>& scene) {
  const auto begins_with = [](const std::string& key, const char* prefix) { return key.rfind(prefix, 0) == 0; };
  const auto ends_with = [](const std::string& key, const std::string& end) {
    return key.size() >= end.size() && key.compare(key.size() - end.size(), end.size(), end) == 0;
  };
  std::string text;
  for (const CaseValue& entry : values_of_case(setup))
    if (entry.key == "element" || entry.key == "geometry" || entry.key == "prestress.pressure" ||
        (begins_with(entry.key, "structure.") && entry.key != "structure.density" && entry.role != KeyRole::running) ||
        (begins_with(entry.key, "support.") && ends_with(entry.key, ".fixed")))
      text += fmt::format("{} = {}\n", entry.key,
                          entry.key == "structure.fibre_frame" && scene.fibre_frame
                              ? fibre_frames().name_of(*scene.fibre_frame)
                              : entry.value);
  const auto loads = support_loads_of(setup);
  const auto at_rest = support_loads_at_rest(setup);
  for (std::size_t i = 0; i < loads.size(); ++i)
    text += fmt::format("load {} of support.{} = {}\n", i + 1, loads[i].surface, at_rest[i]);
  const WallConstants& constants = scene.wall->constants();
  if (constants.wave_speed > 0)  // it is part of the stabilisation
    text += fmt::format("inertia in the stabilisation = {}\n",
                        constants.density * constants.wave_speed * constants.wave_speed);
  return text;
}

std::string hash_of(const std::string& text) {
  Fnv1a hash;
  hash.add(text);
  return hash.hex();
}

constexpr const char* remedy = "leave prestress.file out to find the prestress of this case";

template <int n>
Checkpoint earlier_prestress(const Case& setup, const std::string& text, const std::string& mesh_hash,
                             const Scene<n>& scene) {
  const std::filesystem::path& file = setup.prestress->file;
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError(setup.path.string(), "prestress.file", "there is no file " + file.string(), remedy);
  Checkpoint earlier;
  try {
    const ArrayOrders<n> orders(scene);
    const auto kinds = kinds_of_arrays();
    earlier = read_checkpoint(file, orders.processes(), orders.sharing(kinds));
  } catch (const InputError&) {
    throw InputError(file.string(), "", "cannot be read: it is damaged, or of another version", remedy);
  }
  if (earlier.program != kind)
    throw InputError(file.string(), "", "is no prestress but a checkpoint of " + earlier.program, remedy);
  if (earlier.mesh_hash != mesh_hash) throw InputError(file.string(), "", "belongs to another mesh", remedy);
  if (earlier.case_hash != hash_of(text))
    throw InputError(file.string(), "",
                     "belongs to another wall or load (" + difference_of_cases(earlier.case_text, text) + ")", remedy);
  return earlier;
}

/// "prestress: 100 % of 10.7 kPa, iteration 3, residual 1.2e-05 of the first, 12 s"
PrestressObserver lines_for(const std::function<void(const std::string&)>& goes_on, double pressure) {
  if (!goes_on) return {};
  return [goes_on, pressure, start = std::chrono::steady_clock::now()](const PrestressProgress& now) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    goes_on(fmt::format("prestress: {:.4g} % of {:g} kPa, iteration {}, residual {:.1e} of the first, {:.3g} s",
                        100 * now.load, pressure, now.iteration, now.residual, seconds));
  };
}

}  // namespace

template <int n>
Checkpoint apply_prestress(const Case& setup, const std::string& mesh_hash, Scene<n>& scene,
                           const std::function<void(const std::string&)>& goes_on) {
  const PrestressData& data = setup.prestress.value();
  const auto loads = support_loads_at_rest(setup);
  const std::string text = wall_text(setup, scene);
  Checkpoint kept;
  if (!data.file.empty()) {
    kept = earlier_prestress(setup, text, mesh_hash, scene);
    require_size(data.file, kept, displacement_name, scene.wall->space().vector_size());
    require_size(data.file, kept, wall_name, scene.wall->space().mixed_size());
  } else {
    const auto phase = scene.profile.phase("prestress");
    const WallPrestress found =
        find_prestress<n>(scene, data.pressure, loads, general_solver_factory<n>("fast", FastOptions()),
                          lines_for(goes_on, data.pressure));
    scene.profile.count("newton iterations of the prestress", found.newton_iterations);
    kept.program = kind;
    kept.case_hash = hash_of(text);
    kept.case_text = text;
    kept.mesh_hash = mesh_hash;
    kept.arrays[displacement_name] = found.displacement;
    kept.arrays[wall_name] = found.wall;
  }
  kept.kinds = kinds_of_arrays();
  start_from<n>({kept.arrays.at(displacement_name), kept.arrays.at(wall_name), 0}, data.pressure, loads, scene);
  return kept;
}

std::filesystem::path prestress_file(const std::filesystem::path& folder) {
  return folder / "prestress.h5";
}

#define FSI_INSTANTIATE(n)                                                           \
  template Checkpoint apply_prestress<n>(const Case&, const std::string&, Scene<n>&, \
                                         const std::function<void(const std::string&)>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
