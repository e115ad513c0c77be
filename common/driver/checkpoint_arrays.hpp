#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "scene/scene.hpp"

namespace fsi {

// What stands before the names of a checkpoint's arrays and numbers, by who keeps them.
inline constexpr const char* memory_prefix = "stepper.";
inline constexpr const char* march_prefix = "march.";
inline constexpr const char* digest_prefix = "table.";  ///< bytes and hash of a table's rows
/// Of the statistics over periods, which have a check of their own.
inline constexpr const char* statistics_prefix = "statistics.";

/// What an array of a checkpoint has numbers of.
enum class ArrayKind {
  alike,              ///< the run: all processes have the same
  mesh,               ///< vectors per fluid node
  flow,               ///< vectors and scalars per fluid node
  wall,               ///< vectors and scalars per wall node
  wall_vectors,       ///< vectors per wall node
  interface,          ///< vectors per node between fluid and wall
  interface_columns,  ///< several of these, one after the other
  shear_vectors,      ///< vectors of space per node with wall shear stress
  shear_scalars       ///< a number per node with wall shear stress
};

/// The kind goes by the name; nothing: no array of this name is known. The one place that says so: what is stored under a
/// new name has its kind here.
std::optional<ArrayKind> kind_of_array(const std::string& name);

/// How processes share the arrays of a scene's checkpoint out. Made by all processes together.
template <int n>
class ArrayOrders {
 public:
  /// \param shear_nodes  of the fluid, with wall shear stress; null: there are none. Both must outlive this
  explicit ArrayOrders(const Scene<n>& scene, const std::vector<int>* shear_nodes = nullptr);

  const Communicator& processes() const { return processes_; }
  /// None for what all processes have alike, and for all on one process.
  std::optional<SharedArray> of(const std::string& name) const;
  /// The same as a function, while this lives.
  ArraySharing sharing() const {
    return [this](const std::string& name) { return of(name); };
  }

 private:
  const Communicator& processes_;
  bool coupled_;
  std::optional<WholeOrder> fluid_, wall_, interface_, shear_;
};

}  // namespace fsi
