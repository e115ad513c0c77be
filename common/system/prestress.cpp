#include "system/prestress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "system/step_change.hpp"
#include "system/system.hpp"
#include "system/wall_check.hpp"

namespace fsi {

namespace {

constexpr double smallest_increment = 1.0 / 256;  // of the load
constexpr double same_shape = 1e-3;               // difference of two shapes over the change by an increment

/// Options so tight that displacements are within 1e-6 mm at any load.
NewtonOptions tight_newton(double load, const PrestressObserver& observe) {
  NewtonOptions options;
  options.mode = NewtonMode::full;
  options.tolerance = 1e-10;
  options.residual_tolerance = 1e-10;
  options.linear_tolerance = 1e-8;
  options.max_iterations = 25;
  if (observe)
    options.observe_iteration = [load, &observe](const NewtonReport& so_far) {
      observe({load, so_far.count(), so_far.iterations.back().residual / so_far.first_residual});
    };
  return options;
}

/// Makes the wall's equations those of its unloaded shape as long as it lives.
template <int n>
class Search {
 public:
  explicit Search(Wall<n>& wall) : wall_(wall) { wall_.find_unloaded_shape(true); }
  ~Search() { wall_.find_unloaded_shape(false); }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

 private:
  Wall<n>& wall_;
};

}  // namespace

template <int n>
WallPrestress find_prestress(Scene<n>& scene, double pressure, const std::vector<double>& support_loads,
                             const LinearSolverFactory<n>& make_solver, const PrestressObserver& observe) {
  using Mixed = MixedLayout<n>;
  WallPrestress found;
  State state = scene.at_rest();
  {
    const Search<n> search(*scene.wall);
    System<n> system("prestress", scene, number_wall(scene), make_solver);
    const auto reach = [&](double share) {
      StepData data;
      data.wall_pressure = share * pressure;
      data.support_loads = support_loads;
      for (double& load : data.support_loads) load *= share;
      system.work_on(state, data);
      NewtonReport report = newton(system, tight_newton(share, observe));
      if (report.converged) report.failure = check_wall(scene, state.now.wall).fault;
      report.converged = report.converged && report.failure.empty();
      found.newton_iterations += report.count();
      return report;
    };
    double reached = 0, increment = 1;
    while (reached < 1) {
      const double next = std::min(1.0, reached + increment);
      const auto before = state.now.wall;
      NewtonReport report = reach(next);
      if (report.converged && report.strayed) {  // two halves have to lead to the same shape
        const auto whole = std::exchange(state.now.wall, before);
        report.converged = reach(0.5 * (reached + next)).converged && reach(next).converged &&
                           relative_distance<n>(*scene.wall, before, whole, state.now.wall) <= same_shape;
        report.failure = "in two halves of the load it comes to another shape, or to none";
        state.now.wall = whole;
      }
      if (report.converged) {
        reached = next;
        increment = std::min(2 * increment, 1 - reached);
        continue;
      }
      state.now.wall = before;
      increment /= 2;
      if (increment < smallest_increment)
        throw ConvergenceError(
            fmt::format("prestress: no unloaded shape found for more than {:.3g} of the load, {:.4g} kPa: {}", reached,
                        reached * pressure, report.failure),
            "a stiffer wall, or a smaller prestress.pressure: a wall this soft has hardly a shape that inflates to the "
            "mesh");
    }
  }
  const int nodes = scene.wall->node_count();
  found.displacement.assign(VectorLayout<n>::size(nodes), 0.0);
  found.wall.assign(Mixed::size(nodes), 0.0);
  for (int a = 0; a < nodes; ++a) {
    for (int k = 0; k < n; ++k) found.displacement[VectorLayout<n>::vector(a, k)] = state.now.wall[Mixed::vector(a, k)];
    found.wall[Mixed::scalar(a)] = state.now.wall[Mixed::scalar(a)];
  }
  return found;
}

template <int n>
void start_from(const WallPrestress& prestress, double pressure, const std::vector<double>& support_loads,
                Scene<n>& scene) {
  scene.wall->set_prestress(prestress.displacement);
  scene.initial_load = typename Scene<n>::InitialLoad{pressure, support_loads, prestress.wall};
}

#define FSI_INSTANTIATE(n)                                                                           \
  template WallPrestress find_prestress<n>(Scene<n>&, double, const std::vector<double>&,            \
                                           const LinearSolverFactory<n>&, const PrestressObserver&); \
  template void start_from<n>(const WallPrestress&, double, const std::vector<double>&, Scene<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
