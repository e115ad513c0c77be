#pragma once

#include "monolithic/coupled_solvers/amg/elliptic_amg.hpp"
#include "monolithic/coupled_solvers/amg/saddle_amg.hpp"

namespace fsi {

/// What measurement favoured for each sub-problem of the artery (tests/unit/linear/multigrid_study.cpp prints the
/// table): one V-cycle gains about a digit on the coarse and intermediate mesh.

/// Blood: mass-dominated, and its stabilisation time is half the time step whatever the mesh, so that the Galerkin
/// stabilisation is right on coarse levels as it is. The factor 1.2 makes up for diagonal blocks that underestimate A:
/// it lowers Ahat^-1, in the Schur complement and in the velocity correction.
inline SaddleAmgOptions fluid_amg_options() {
  SaddleAmgOptions options;
  options.stabilisation_growth = 0;
  options.braess_sarazin.momentum_sweeps = 2;
  options.braess_sarazin.schur_sweeps = 1;
  options.braess_sarazin.scaling = 1.2;
  return options;
}

/// The wall: three elements thick, so that its coarse displacement spaces lock and coarse pressure corrections come out
/// up to four times too large; the Schur complement must be solved well to damp that, on small levels exactly. On all
/// but fine meshes it is close to the stabilisation, so that its smallest entries may be lumped.
inline SaddleAmgOptions wall_amg_options(SaddleSmootherKind smoother = SaddleSmootherKind::braess_sarazin) {
  SaddleAmgOptions options;
  options.smoother = smoother;
  // Vanka has no sweeps for the pressure alone, so coarse corrections of the pressure are damped more.
  options.scalar_correction = smoother == SaddleSmootherKind::vanka ? 0.5 : 0.7;
  options.interior_from_interface = false;
  options.stabilisation_growth = 1.0 / 3.0;
  options.braess_sarazin.momentum_sweeps = 2;
  options.braess_sarazin.schur_sweeps = 3;
  options.braess_sarazin.schur_drop = 0.01;
  options.braess_sarazin.schur_direct_nodes = 1500;
  return options;
}

/// The mesh motion: a Laplacian, next to nothing in cost beside the others.
inline EllipticAmgOptions mesh_amg_options() {
  EllipticAmgOptions options;
  options.interior_from_interface = true;
  options.smoothing = 4.0 / 3.0;
  options.cycle.pre_smoothing = options.cycle.post_smoothing = 2;
  return options;
}

}  // namespace fsi
