#include "linear/distributed/mesh_extensions.hpp"

#include <utility>

#include "fem/dimensions.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "mesh_motion/tangent_extension.hpp"
#ifdef FSI_WITH_MPI
#include "linear/distributed/petsc_extension.hpp"
#include "linear/distributed/petsc_options.hpp"
#include "linear/policy/solver_policy.hpp"
#endif

namespace fsi {

#ifdef FSI_WITH_MPI
namespace {

std::int64_t factorised_at_first_below(int dimension) {
  return SolverPolicy(SolvedSystem::shared_mesh_motion, dimension, {std::nullopt, has_petsc_options()})
      .factorises_below();
}

}  // namespace
#endif

template <int n>
std::unique_ptr<MeshExtension<n>> make_harmonic_extension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner,
                                                          const NodalFrames<n>* frames,
                                                          [[maybe_unused]] const PartNodes& part,
                                                          const HarmonicExtensionOptions& options) {
#ifdef FSI_WITH_MPI
  if (part.share) {
    const auto by_petsc = [&laplacian, inner, frames, &part](std::int64_t central_below) {
      return std::make_unique<PetscExtension<n>>(laplacian, inner, frames, part, central_below);
    };
    if (has_petsc_options() || part.processes().any(HarmonicExtension<n>::mixes(frames)))
      return by_petsc(factorised_at_first_below(n));
    return std::make_unique<HarmonicExtension<n>>(
        laplacian, inner, frames, *part.share, [by_petsc] { return by_petsc(0); }, options);
  }
#endif
  return std::make_unique<HarmonicExtension<n>>(laplacian, std::move(inner), options, frames);
}

template <int n>
std::unique_ptr<MeshExtension<n>> make_tangent_extension(const MeshMotionTangent<n>& tangent, std::vector<char> inner,
                                                         [[maybe_unused]] const PartNodes& part) {
#ifdef FSI_WITH_MPI
  if (part.share)
    return std::make_unique<PetscExtension<n>>(tangent, std::move(inner), part, factorised_at_first_below(n));
#endif
  return std::make_unique<TangentExtension<n>>(tangent, std::move(inner));
}

template <int n>
std::unique_ptr<MeshExtension<n>> make_shared_extension(const JacobianBlocks<n>& blocks, std::vector<char> inner) {
  if (blocks.mesh_tangent)
    return make_tangent_extension<n>(*blocks.mesh_tangent, std::move(inner), *blocks.fluid_nodes);
  HarmonicExtensionOptions options;
  options.single_precision = true;  // few digits are asked for: CondensedIteration::extension_share
  return make_harmonic_extension<n>(*blocks.mesh_laplacian, std::move(inner), blocks.fluid_frames, *blocks.fluid_nodes,
                                    options);
}

template <int n>
using OwnedExtension = std::unique_ptr<MeshExtension<n>>;

#define FSI_INSTANTIATE(n)                                                                                             \
  template OwnedExtension<n> make_harmonic_extension(const BlockMatrix<1, n>&, std::vector<char>,                      \
                                                     const NodalFrames<n>*, const PartNodes&,                          \
                                                     const HarmonicExtensionOptions&);                                 \
  template OwnedExtension<n> make_tangent_extension(const MeshMotionTangent<n>&, std::vector<char>, const PartNodes&); \
  template OwnedExtension<n> make_shared_extension(const JacobianBlocks<n>&, std::vector<char>);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
