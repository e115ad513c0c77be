#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "partitioned/interface_space.hpp"
#include "time/restart_archive.hpp"

namespace fsi {

/// A linear map J = sum of a_i b_i^T between interface vectors.
class LowRankMap {
 public:
  explicit LowRankMap(const InterfaceSpace& space = {}) : space_(space) {}

  static constexpr double truncation = 1e-4;  ///< tolerance for truncate() that its callers use

  std::size_t rank() const { return a_.size(); }
  void clear();
  void add(std::vector<double> a, std::vector<double> b);
  /// J x. Collective.
  std::vector<double> times(const std::vector<double>& x) const;
  /// Replaces J by its best approximation of a rank of at most `rank`, singular values below `tolerance` times the
  /// largest left out (the restart RS-SVD of [Scheufele2017]). Collective.
  void truncate(std::size_t rank, double tolerance);

  void keep(RestartArchive& archive, const std::string& name);

  const std::vector<std::vector<double>>& left() const { return a_; }
  const std::vector<std::vector<double>>& right() const { return b_; }

 private:
  InterfaceSpace space_;
  std::vector<std::vector<double>> a_, b_;
};

}  // namespace fsi
