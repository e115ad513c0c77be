#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "partitioned/interface_problem.hpp"
#include "partitioned/relaxation.hpp"
#include "scene/case.hpp"

namespace fsi {

/// Advances fluid and wall in turn: relaxed fixed-point iteration d <- d + correction(d~ - d) on the interface
/// displacement, from an extrapolated guess until |d~ - d| <= tolerance |d~|. Sub-problems are solved a hundred times
/// tighter.
template <class Element>
class FixedPointStepper : public Stepper {
 public:
  FixedPointStepper(Scene<Element>& scene, const Loads& loads, const PartitionedData& options)
      : scene_(scene),
        loads_(loads),
        options_(options),
        relaxation_(make_relaxation(options.scheme, options.relaxation)),
        interface_(scene, sub_problem_options(options)) {}

  StepReport advance(State& state) override {
    StepData data = loads_.next(state, scene_.scheme);
    scene_.scheme.predict(state);
    scene_.impose_interface(state);
    interface_.start(state, data);
    interface_.fluid_iterations = interface_.wall_iterations = 0;
    relaxation_->start();

    report_ = {};
    StepReport& report = report_;
    auto d = interface_.wall_displacement();
    double error = 0;
    for (report.outer_iterations = 1; report.outer_iterations <= options_.max_iterations; ++report.outer_iterations) {
      const auto answer = solve_at(d, state, data);
      auto residual = answer;
      for (std::size_t i = 0; i < d.size(); ++i) residual[i] -= d[i];
      error = norm(residual) / std::max(norm(answer), 1e-300);
      report.history.push_back(fmt::format(
          "coupling {:3d}  |d~ - d| / |d~| = {:.3e}  relaxation {:.5f}  newton {} + {}", report.outer_iterations, error,
          relaxation_->factor(), interface_.fluid_iterations, interface_.wall_iterations));
      if (error <= options_.tolerance) {
        report.newton_iterations = interface_.fluid_iterations + interface_.wall_iterations;
        scene_.scheme.accept(state, data);
        return report;
      }
      relaxation_->correct(d, residual);
    }
    throw ConvergenceError(
        fmt::format("step {} (to t = {:g} ms): the {} fixed point did not converge in {} iterations, |d~ - d| / |d~| = "
                    "{:.2e}, wanted {:g}",
                    state.step + 1, data.time, options_.scheme, options_.max_iterations, error, options_.tolerance),
        options_.scheme == "constant" ? "partitioned.scheme = \"aitken\", or a smaller partitioned.relaxation"
                                      : "a larger partitioned.max_iterations, or the monolithic driver");
  }

  Memory memory() const override {
    Memory memory = interface_.memory();
    memory.numbers["relaxation"] = relaxation_->factor();
    return memory;
  }
  void recall(const Memory& memory) override {
    interface_.recall(memory);
    const auto factor = memory.numbers.find("relaxation");
    if (factor != memory.numbers.end()) relaxation_->set_factor(factor->second);
  }

 private:
  static NewtonOptions sub_problem_options(const PartitionedData& options) {
    NewtonOptions newton;
    newton.tolerance = 0.01 * options.tolerance;
    return newton;
  }
  static double norm(const std::vector<double>& x) {
    double sum = 0;
    for (double value : x) sum += value * value;
    return std::sqrt(sum);
  }
  std::vector<double> solve_at(const std::vector<double>& d, const State& state, const StepData& data) {
    try {
      return interface_.answer(d, report_.history);
    } catch (const ConvergenceError& e) {
      throw ConvergenceError(fmt::format("step {} (to t = {:g} ms): {}", state.step + 1, data.time, e.what()), "");
    }
  }

  Scene<Element>& scene_;
  const Loads& loads_;
  PartitionedData options_;
  std::unique_ptr<Relaxation> relaxation_;
  InterfaceProblem<Element> interface_;
};

}  // namespace fsi
