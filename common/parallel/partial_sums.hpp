#pragma once

#include <cstddef>
#include <vector>

#include "parallel/communicator.hpp"

namespace fsi {

/// Numbers of which each process has a part: collected where they stand, and added up over the processes in one message.
class PartialSums {
 public:
  /// Must stay where they are until add_up(). All processes name as many, in one order.
  void include(double& number) { parts_.push_back(&number); }
  void include(std::vector<double>& numbers) {
    for (double& number : numbers) include(number);
  }

  /// Gives each number its sum over the processes, at all of them.
  void add_up(const Communicator& processes) {
    if (processes.is_alone()) return;
    std::vector<double> message;
    message.reserve(parts_.size());
    for (const double* part : parts_) message.push_back(*part);
    processes.sum(message);
    for (std::size_t i = 0; i < parts_.size(); ++i) *parts_[i] = message[i];
  }

 private:
  std::vector<double*> parts_;
};

}  // namespace fsi
