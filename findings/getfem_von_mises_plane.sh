#!/usr/bin/env bash
# GetFEM's von Mises stress of plane problems is that of two dimensions: the deviator is taken by half the trace of the stress in
# the plane, as if there were no third direction. A strip in tension 1, in plane stress, has 0.866; a sheet pulled equally in
# both directions, or a section of a vessel's wall in plane strain that is widened likewise, has 0. Nothing is said. There are
# two functions, one for plane stress and one for plane strain; in 3D both are right.
# A guess would be 1 for the strip, by sqrt(s1^2 - s1 s2 + s2^2) in plane stress, and the third stress counted in plane strain.
# Seen with GetFEM 5.4.2 (Debian 12): E = 1, nu = 0.3. In plane strain the right value is 2 mu = 0.769 times the strain, whether
# it is widened in one direction or in both.
# Output seen: plane stress: strip 0.866, sheet 0, right 1 and 1; plane strain: one direction 0.666, both 0, right 0.769 and
# 0.769; 3D: bar in tension 1 by both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-getfem=5.4.2+dfsg1-3+b1
cat >"$scratch/12/root/stress.py" <<'END'
import getfem
import numpy

POISSON = 0.3


def von_mises(function, *strains):
    """The von Mises stresses of a block, or a square, with these strains along its edges."""
    edge = numpy.array([0.0, 1.0])
    mesh = getfem.Mesh("regular simplices", *(edge for _ in strains))
    displacements = getfem.MeshFem(mesh, len(strains))
    displacements.set_classical_fem(1)
    stresses = getfem.MeshFem(mesh, 1)
    stresses.set_classical_discontinuous_fem(0)
    model = getfem.Model("real")
    model.add_fem_variable("u", displacements)
    model.add_initialized_data("E", 1.0)
    model.add_initialized_data("nu", POISSON)
    stretched = ", ".join(f"{strain} * {axis}" for strain, axis in zip(strains, "xyz"))
    model.set_variable("u", displacements.eval(f"[{stretched}]"))
    values = getattr(model, f"compute_isotropic_linearized_Von_Mises_{function}")("u", "E", "nu", stresses)
    return " to ".join(sorted({f"{value:.3f}" for value in values}))


print("plane stress, strip:", von_mises("pstress", 1, -POISSON))
print("plane stress, sheet:", von_mises("pstress", 1 - POISSON, 1 - POISSON))
print("plane strain, one direction:", von_mises("pstrain", 1, 0))
print("plane strain, both directions:", von_mises("pstrain", 1, 1))
for function in ("pstress", "pstrain"):
    print(f"3D, bar, by {function}:", von_mises(function, 1, -POISSON, -POISSON))
END
within "$scratch/12" python3 /root/stress.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the stresses"
plane stress, strip: 0.866
plane stress, sheet: 0.000
plane strain, one direction: 0.666
plane strain, both directions: 0.000
3D, bar, by pstress: 1.000
3D, bar, by pstrain: 1.000
END
