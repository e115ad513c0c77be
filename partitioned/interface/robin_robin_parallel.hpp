#pragma once

#include <vector>

#include "partitioned/interface/robin_robin.hpp"

namespace fsi {

/// Robin-Robin with data of the last step alone ([Guo2025]; docs/theory.md, section 10.5): fluid and wall know nothing
/// of each other within a step and can be solved at once. L being the load that the wall bore,
///   W^(n+1) + lambda^n + c (w^(n+1) - u^n) = 0,
///   F^(n+1) - L^n + c (u^(n+1) - w^n) = 0,   L^n = lambda^(n-1) + c (w^n - u^(n-1)).
/// x is the extrapolated displacement, which the fluid's domain follows. Steps that are iterated are those of
/// RobinRobin.
template <int n>
class RobinRobinParallel : public RobinRobin<n> {
  using Base = RobinRobin<n>;

 public:
  RobinRobinParallel(Scene<n>& scene, const PartitionedData& options) : Base(scene, options) {
    for (auto* numbers : {&wall_load_, &wall_velocity_, &next_velocity_}) numbers->assign(Base::interface_size(), 0.0);
  }

  void accept() override {
    Base::accept();
    next_velocity_ = Base::velocity_of_wall(Base::wall_displacement(Base::state_->now));
  }
  void follow_wall() override { Base::move_mesh_to_wall(); }

  void finish_step() override {
    Base::finish_step();
    wall_load_ = Base::load();
    wall_velocity_ = next_velocity_;
  }

  void keep(RestartArchive& archive) override {
    Base::keep(archive);
    if (!archive.wants({"robin_load", "robin_velocity"})) return;
    archive.array("robin_load", ArrayKind::interface, wall_load_);
    archive.array("robin_velocity", ArrayKind::interface, wall_velocity_);
  }

 protected:
  Pass single_pass(const std::vector<double>& x, const PassAccuracy& accuracy) override {
    Base::move_mesh(x);
    Base::answer_of_fluid(wall_velocity_, wall_load_, accuracy);
    Base::answer_of_wall(Base::last_velocity(), Base::traction_, accuracy);
    return Base::finished_pass(Base::wall_displacement(Base::state_->now));
  }

  void find_data(State& state, StepData& data) override {
    Base::find_data(state, data);
    wall_load_ = Base::traction_;
    wall_velocity_ = Base::last_velocity();
  }

 private:
  std::vector<double> wall_load_, wall_velocity_;  ///< L^n, kPa mm^2; w^n, mm/ms
  std::vector<double> next_velocity_;              ///< of the step in progress
};

}  // namespace fsi
