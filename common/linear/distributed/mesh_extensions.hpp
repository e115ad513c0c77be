#pragma once

#include <memory>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "fem/nodal_frames.hpp"
#include "linear/interface/linear_solver.hpp"
#include "mesh/submesh.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "mesh_motion/mesh_extension.hpp"
#include "mesh_motion/nonlinear_mesh_motion.hpp"

namespace fsi {

/// The solver of a harmonic or stiffened mesh motion, of the fluid's nodes `part`: HarmonicExtension. Where the part is shared
/// out, frames that mix components and cases with options of PETSc take PetscExtension; right sides count at own entries, and
/// fields hold ghosts: given values have to be in them, sought ones are brought to them.
/// \param laplacian  conditions not imposed; must outlive this, and so must `frames` and `part`
/// \param inner      per node and component, in the frames: its value is sought. What stands there for ghosts does not
///                   matter
/// \param frames     null: none
template <int n>
std::unique_ptr<MeshExtension<n>> make_harmonic_extension(const BlockMatrix<1, n>& laplacian, std::vector<char> inner,
                                                          const NodalFrames<n>* frames, const PartNodes& part,
                                                          const HarmonicExtensionOptions& options = {});

/// The same for a linearised nonlinear motion: TangentExtension, or PETSc. update() has to come first.
/// \param tangent  with components along the frames of nodes that have one
template <int n>
std::unique_ptr<MeshExtension<n>> make_tangent_extension(const MeshMotionTangent<n>& tangent, std::vector<char> inner,
                                                         const PartNodes& part);

/// That of a Jacobian's mesh motion: of its tangent where there is one, else harmonic, with factors in single
/// precision.
/// \param inner  per node and component: its value is sought
template <int n>
std::unique_ptr<MeshExtension<n>> make_shared_extension(const JacobianBlocks<n>& blocks, std::vector<char> inner);

}  // namespace fsi
