#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "io/result_folder.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What openings.csv shows of a state, in cases with [[opening]].
template <int n>
class OpeningObserver {
 public:
  OpeningObserver(const Case& setup, const Scene<n>& scene);

  /// Of the openings that the mesh has, in their order; empty where the case asks for no such table.
  const std::vector<std::string>& names() const { return names_; }
  std::vector<OpeningRecord> look(const State& level) const;
  /// Adds the rows of the state's current time level.
  void write(const State& level, ResultFolder& folder) const;
  /// As Observables::require_same(). \throws InputError
  void require_same(const State& level, const EarlierTables& earlier) const;

 private:
  const Scene<n>& scene_;
  std::vector<std::size_t> openings_;  ///< their numbers
  std::vector<std::string> names_;
};

}  // namespace fsi
