#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "time/time_integrator.hpp"

namespace fsi::test {

/// A time scheme that says before each stage which rates it will have, so that prescribed values can follow it.
class ToldOfStages : public TimeIntegrator {
 public:
  using Tell = std::function<void(const StepRates&)>;
  ToldOfStages(std::unique_ptr<const TimeIntegrator> scheme, Tell tell)
      : scheme_(std::move(scheme)), tell_(std::move(tell)) {}

  ErrorTerms error_terms() const override { return scheme_->error_terms(); }
  NewmarkParameters newmark() const override { return scheme_->newmark(); }
  void prepare(State& state) const override { scheme_->prepare(state); }
  int stages(const State& state) const override { return scheme_->stages(state); }
  void predict(State& state, int order, const StepData& data) const override { scheme_->predict(state, order, data); }
  std::array<double, 3> balance_weights(const State& state, int order, const StepData& data) const override {
    return scheme_->balance_weights(state, order, data);
  }
  std::optional<Balance> balance_again(const State& state) const override { return scheme_->balance_again(state); }
  void accept(State& state, const StepData& data) const override { scheme_->accept(state, data); }
  bool pressures_lag() const override { return scheme_->pressures_lag(); }

 private:
  StepRates rates_of(const State& state, double step, int stage) const override {
    StepRates rates = scheme_->rates(state, step, stage);
    tell_(rates);
    return rates;
  }

  std::unique_ptr<const TimeIntegrator> scheme_;
  Tell tell_;
};

}  // namespace fsi::test
