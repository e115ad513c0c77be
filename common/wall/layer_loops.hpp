#pragma once

#include <type_traits>
#include <vector>

#include "fem/assembly_result.hpp"
#include "wall/hyperelastic.hpp"
#include "wall/varying_hyperelastic.hpp"
#include "wall/wall_input.hpp"

namespace fsi {

/// Laws whose element loops are compiled in files of their own, side by side with the others: what a compiler makes of
/// one law's loops, to the last bit, does not depend on how many laws there are.
template <class M>
inline constexpr bool compiled_apart =
    std::is_same_v<M, CompressibleLaw> || std::is_same_v<M, DispersedArtery> || std::is_same_v<M, VaryingLaw>;

/// Their loops over one layer, see assemble_wall(), wall_energy() and wall_work(). Defined in
/// wall/layer_loops_of.hpp.
template <class Element, class M>
struct LayerLoops {
  static AssemblyResult assemble(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const WallInput& in,
                                 std::vector<double>& residual, WallMatrix<Element::components>* jacobian);
  static WallEnergy energy(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const double* wall,
                           const double* velocity, const double* balance, const double* prestress);
  static WallWork work(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const WallStep& step);
};

/// The loops that find the unloaded shape (wall/unloaded_shape.hpp), of every law; a Jacobian is always passed. In
/// unloaded_loops.cpp.
template <class Element, class M>
struct UnloadedLoops {
  static AssemblyResult assemble(const Hyperelastic<M>& form, const WallLayer<Element>& layer, const WallInput& in,
                                 std::vector<double>& residual, WallMatrix<Element::components>* jacobian);
};

}  // namespace fsi
