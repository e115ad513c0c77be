"""Theory of the pressure wave's speed against the numbers published for this project, and against known limits."""

import math
import tempfile
import unittest
from pathlib import Path

import synthetic  # noqa: F401: the package's folder onto the path

from fsi_compare.base.errors import InputError
from fsi_research.evidence.tube import Layer, Tube, read_tube
from fsi_research.evidence.wave_speed import long_wave, moens_korteweg, phase_speed, wall_stiffness

CASES = Path(__file__).resolve().parents[3] / "meshes" / "artery"


class Artery(unittest.TestCase):
    def tube(self, material, **changes):
        return read_tube(CASES / f"{material}.toml", **changes)

    def test_long_waves(self):
        for material, expected in (("neo-hookean", 0.939), ("mooney-rivlin", 0.993), ("artery", 1.293)):
            self.assertAlmostEqual(long_wave(self.tube(material)), expected, 3)

    def test_the_printed_half_of_the_fibres(self):
        self.assertAlmostEqual(long_wave(self.tube("artery", fibre_scale=0.5)), 1.130, 3)

    def test_without_fibres_the_artery_is_neo_hookean(self):
        self.assertAlmostEqual(long_wave(self.tube("artery", fibre_scale=0.0)), long_wave(self.tube("neo-hookean")), 14)

    def test_dispersion(self):
        tube = self.tube("neo-hookean")
        for product, expected in ((0.5, 0.907), (1, 0.829), (2, 0.650), (3, 0.515)):
            self.assertAlmostEqual(phase_speed(tube, product / tube.radius), expected, 3)
        self.assertAlmostEqual(phase_speed(tube, 1e-4), long_wave(tube), 6)

    def test_wall_stiffness_is_the_slope_of_the_closed_form_inflation(self):
        """p = sum of mu [ln(B a/(A b)) + k/2 (1/a^2 - 1/b^2)], k = a_i^2 - R_i^2."""
        tube, stretch = self.tube("mooney-rivlin"), 1e-6
        k = tube.radius**2 * ((1 + stretch) ** 2 - 1)
        pressure = 0.0
        for layer in tube.layers:
            a, b = math.sqrt(layer.inner**2 + k), math.sqrt(layer.outer**2 + k)
            pressure += layer.shear * (math.log(layer.outer * a / (layer.inner * b)) + k / 2 * (a**-2 - b**-2))
        self.assertAlmostEqual(pressure / (stretch * tube.radius), wall_stiffness(tube), 5)

    def test_a_case_of_another_kind_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            wall = Path(folder) / "wall.toml"
            wall.write_text("[structure]\ndensity = 1.2\n")
            for case, expected in ((wall, "holds no fluid-filled tube"), (Path(__file__), "is not TOML")):
                with self.assertRaises(InputError) as caught:
                    read_tube(case)
                self.assertIn(expected, str(caught.exception))


class MoensKorteweg(unittest.TestCase):
    def test_one_isotropic_layer(self):
        """c^2 = E h / (2 rho R) with E = 3 mu; held at its length E / (1 - nu^2) = 4 mu."""
        tube = Tube([Layer(10.0, 10.5, 2.0)], 1.1, 1.2)
        self.assertAlmostEqual(moens_korteweg(tube), math.sqrt(3 * 2.0 * 0.5 / (2 * 1.1 * 10)), 14)
        self.assertAlmostEqual(moens_korteweg(tube, restrained=True), math.sqrt(4 * 2.0 * 0.5 / (2 * 1.1 * 10)), 14)

    def test_the_thick_wall_becomes_the_thin_one(self):
        ratio = [
            long_wave(tube) / moens_korteweg(tube, restrained=True)
            for tube in (Tube([Layer(1.0, 1.0 + h, 2.0, 1.5, 30.0)], 1.0, 1.0) for h in (1e-2, 1e-3))
        ]
        self.assertAlmostEqual(ratio[1], 1, 2)
        self.assertAlmostEqual((1 - ratio[0]) / (1 - ratio[1]), 10, delta=0.5)  # first order in h/R

    def test_fibres_that_the_shortening_slackens_do_not_act(self):
        """Along the axis they would hold the length; a wall free to shorten slackens them."""
        plain, axial = (Tube([Layer(1.0, 1.1, 2.0, k1, 90.0)], 1.0, 1.0) for k1 in (0.0, 5.0))
        self.assertAlmostEqual(moens_korteweg(axial), moens_korteweg(plain), 14)
        around = Tube([Layer(1.0, 1.1, 2.0, 5.0, 0.0)], 1.0, 1.0)
        self.assertAlmostEqual(moens_korteweg(around) ** 2 - moens_korteweg(plain) ** 2, 8 * 5.0 * 0.1 / 2, 12)


if __name__ == "__main__":
    unittest.main()
