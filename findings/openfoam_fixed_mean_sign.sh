#!/usr/bin/env bash
# OpenFOAM's boundary condition fixedMean, which gives a patch a mean value, multiplies what is in the cells beside it by the
# ratio of two magnitudes, wanted and present, unless the present one is below half of the wanted one. So the sign of the cells
# stays: asked for -3 where the cells have 4, a patch has 3, and still has once the solution is steady; with 0 in the cells at
# the start it has -3. A mean velocity that is turned round from one time step to the next goes on forwards, and what was to be
# the back flow of diastole is forward flow. Nothing is said.
# A guess would be that what is missing of the mean is added, which the condition does only where the cells have little.
# Seen with OpenFOAM 1912 (Debian 12): a rod held at 4 on the left, mean -3 on the right, from 4 and from 0 everywhere; a channel
# whose mean inflow is 1 up to time 0.5 and -1 from 0.55 on, time step 0.05.
# Output seen: right end of the rod 3 from 4, -3 from 0; inflow at times 0.5, 0.55 and 1: 1, 1, 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" openfoam=1912.200626-1+b1 libopenfoam=1912.200626-1+b1

# entry CASE FILE CLASS: a file of a case, from standard input.
entry() {
  mkdir -p "$scratch/12/root/$1/${2%/*}"
  { echo "FoamFile { version 2.0; format ascii; class $3; object ${2##*/}; }" && cat; } >"$scratch/12/root/$1/$2"
}

# made CASE PROGRAM END STEP FIELD PATCH: what both cases have, run. The function object writes the field's mean on the patch.
made() {
  entry "$1" system/controlDict dictionary <<END
startFrom startTime; startTime 0; stopAt endTime; endTime $3; deltaT $4; writeControl timeStep; writeInterval 20;
functions
{
  mean { type surfaceFieldValue; libs ("libfieldFunctionObjects.so"); fields ($5); operation areaAverage; regionType patch;
         name $6; writeFields no; }
}
END
  entry "$1" system/fvSchemes dictionary <<'END'
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default Gauss upwind; }
laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
END
  entry "$1" system/fvSolution dictionary <<'END'
solvers
{
  "(T|p|pFinal)" { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; }
  U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-12; relTol 0; }
}
SIMPLE { nNonOrthogonalCorrectors 0; } PISO { nCorrectors 2; nNonOrthogonalCorrectors 0; }
END
  entry "$1" system/blockMeshDict dictionary <<'END'
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) (10 1 1) simpleGrading (1 1 1));
boundary ( left { type patch; faces ((0 4 7 3)); } right { type patch; faces ((1 2 6 5)); } );
defaultPatch { name sides; type empty; }
END
  within "$scratch/12" env WM_PROJECT_DIR=/usr/share/openfoam sh -c "cd /root/$1 && blockMesh && $2" >"$scratch/log" 2>&1 ||
    fail "$2 ends with $(tail -n 20 "$scratch/log")"
}

for start in 4 0; do
  entry "rod$start" constant/transportProperties dictionary <<<"DT DT [0 2 -1 0 0 0 0] 1;"
  entry "rod$start" 0/T volScalarField <<END
dimensions [0 0 0 1 0 0 0]; internalField uniform $start;
boundaryField
{
  left { type fixedValue; value uniform 4; }
  right { type fixedMean; meanValue constant -3; value uniform 0; }
  sides { type empty; }
}
END
  made "rod$start" laplacianFoam 20 1 T right
  awk -v start="$start" '$1 == 20 { printf "rod from %s: %g\n", start, $2 }' \
    "$scratch/12/root/rod$start/postProcessing/mean/0/"*.dat
done >"$scratch/said"

entry channel constant/transportProperties dictionary <<<"nu nu [0 2 -1 0 0 0 0] 0.001;"
entry channel 0/U volVectorField <<'END'
dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0);
boundaryField
{
  left { type fixedMean; meanValue table ((0 (1 0 0)) (0.5 (1 0 0)) (0.55 (-1 0 0)) (1 (-1 0 0))); value uniform (1 0 0); }
  right { type zeroGradient; }
  sides { type empty; }
}
END
entry channel 0/p volScalarField <<'END'
dimensions [0 2 -2 0 0 0 0]; internalField uniform 0;
boundaryField
{
  left { type zeroGradient; }
  right { type fixedValue; value uniform 0; }
  sides { type empty; }
}
END
made channel icoFoam 1 0.05 U left
awk '$1 == 0.5 || $1 == 0.55 || $1 == 1 { sub(/\(/, "", $2); printf "channel at %s: %g\n", $1, $2 }' \
  "$scratch/12/root/channel/postProcessing/mean/0/"*.dat >>"$scratch/said"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the means"
rod from 4: 3
rod from 0: -3
channel at 0.5: 1
channel at 0.55: 1
channel at 1: 1
END
