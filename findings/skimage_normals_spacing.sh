#!/usr/bin/env bash
# marching_cubes of scikit-image takes the spacing of the voxels, and gives vertices in these units, but normals as if
# all voxels were cubes. Where slices are thicker than the pixels in them, as in many scans of vessels, the normals do
# not stand on the surface: at voxels of 1 x 1 x 3 an oblique wall has them 27 degrees off. Their length is 1, and
# nothing is said. So a velocity along the wall has a part across it, and wall shear stress, or a layer that is grown
# along normals, is wrong. With cubic voxels, and on walls that lie along the axes, all is right, so a test by such
# shows nothing.
# Nor do the triangles help by themselves: with the default, gradient_direction "descent", those of a bright object are
# turned inwards, by the left-hand rule as documented, against the normals, which point outwards. "ascent" turns the
# triangles; the normals stay.
# A guess would be that vertices, triangles and normals belong to one surface.
# The same in 0.19.3 (Debian 12) and 0.25.2 (Debian 13): a block, bright where x + z is small, so that its wall has the
# normal (0.707, 0, 0.707); velocity (0.707, 0, -0.707), along the wall.
# Output seen, normal, velocity across the wall, normal of the triangles: spacing 1 1 1: 0.707 0 0.707, 0, -0.707 0
# -0.707; spacing 1 1 3: 0.316 0 0.949, -0.447, -0.707 0 -0.707; with "ascent" the same normals, triangles 0.707 0
# 0.707.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-skimage=0.19.3-8
debian trixie "$scratch/13" python3-skimage=0.25.2-2
for root in 12 13; do
  cat >"$scratch/$root/root/normals.py" <<'END'
import numpy
import skimage
from skimage.measure import marching_cubes


def words(vector):
    return " ".join(f"{value:.3f}".replace("-0.000", "0").replace("0.000", "0") for value in vector)


def only(vectors):
    """The one vector that all of these are."""
    assert numpy.ptp(vectors, axis=0).max() < 1e-4, vectors
    return vectors.mean(axis=0)


print(f"scikit-image {skimage.__version__}")
along = numpy.array([1, 0, -1]) / 2**0.5
for spacing in ((1, 1, 1), (1, 1, 3)):
    for direction in ("descent", "ascent"):
        x, y, z = numpy.indices((21, 5, 21)) * numpy.reshape(spacing, (3, 1, 1, 1))
        vertices, triangles, normals, _ = marching_cubes(20.3 - x - z, 0, spacing=spacing, gradient_direction=direction)
        assert abs(vertices[:, 0] + vertices[:, 2] - 20.3).max() < 1e-4
        a, b, c = (vertices[triangles[:, k]] for k in range(3))
        across = numpy.cross(b - a, c - a)
        across = across[numpy.linalg.norm(across, axis=1) > 1e-3]
        normal = only(normals)
        print(f"spacing {spacing}, {direction}: normal {words(normal)}, velocity across {words([normal @ along])},",
              f"triangles {words(only(across / numpy.linalg.norm(across, axis=1)[:, None]))}")
END
  within "$scratch/$root" python3 /root/normals.py >"$scratch/$root/said" 2>"$scratch/log" ||
    fail "python ends with $(cat "$scratch/log")"
  [ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
  cat "$scratch/$root/said"
done
for root in 12 13; do
  version=0.19.3
  [ "$root" = 12 ] || version=0.25.2
  diff "$scratch/$root/said" - <<END || fail "the normals of $version"
scikit-image $version
spacing (1, 1, 1), descent: normal 0.707 0 0.707, velocity across 0, triangles -0.707 0 -0.707
spacing (1, 1, 1), ascent: normal 0.707 0 0.707, velocity across 0, triangles 0.707 0 0.707
spacing (1, 1, 3), descent: normal 0.316 0 0.949, velocity across -0.447, triangles -0.707 0 -0.707
spacing (1, 1, 3), ascent: normal 0.316 0 0.949, velocity across -0.447, triangles 0.707 0 0.707
END
done
