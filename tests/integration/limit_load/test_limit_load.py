"""A neo-Hookean tube under more pressure than it bears at rest: the programs say so, and only then."""

import unittest
from pathlib import Path

from programs import ARTERY, DRIVERS, MONOLITHIC, NEO_HOOKEAN, PARTITIONED, FolderTest, attempt, summary

STATIC = Path(__file__).parents[1] / "wall" / "static_wall.toml"
LIMIT = "bears less than 0.523 kPa at rest"  # sum over the layers of mu ln(B/A): 3 ln(1.69/1.43) + 0.3 ln(1.82/1.69)
QUIET = ("output.every=0", "output.checkpoint_every=0")


class LimitLoad(FolderTest):
    def failure(self, program, case, *settings):
        process = attempt(program, case, "-q", "--force", folder=self.base / "run", settings=(*QUIET, *settings))
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(process.stderr.count("\n"), 1)
        return process.stderr

    def test_at_rest(self):
        for program in DRIVERS:
            said = self.failure(program, STATIC, "load.pressure=1.332", "static.load_steps=1", "static.retries=0")
            self.assertIn("load step 1 (to 1 of the load)", said)
            self.assertIn(LIMIT, said)
            self.assertIn("artery", said)

    def test_at_rest_below_the_limit(self):
        said = self.failure(MONOLITHIC, STATIC, "load.pressure=0.5", "static.load_steps=3", "static.retries=1")
        self.assertIn(LIMIT, said)
        self.assertIn("may be the limit load of this one; on a coarse mesh the wall is too soft", said)

    def test_one_pass_a_step_names_the_added_mass(self):
        said = self.failure(PARTITIONED, NEO_HOOKEAN, 'partitioned.scheme="explicit"', "time.end=1")
        self.assertRegex(said, "is unstable: the fluid's added mass is .*the fluid's added mass exceeds the wall's")

    def test_long_pulse(self):
        for program, scheme in ((MONOLITHIC, "aitken"), (PARTITIONED, "robin-neumann-iqn")):
            said = self.failure(program, NEO_HOOKEAN, "inlet.until=5", "time.end=5", f'partitioned.scheme="{scheme}"')
            self.assertRegex(said, r"the wall is stretched to 1\.\d\d times its length near z = \d")
            self.assertIn(LIMIT, said)
            self.assertIn(LIMIT, summary(self.base / "run")["failure"])

    def test_pulse_that_has_ended_when_the_wall_is_lost(self):
        said = self.failure(MONOLITHIC, NEO_HOOKEAN, "inlet.until=2", "time.end=4")
        self.assertIn(LIMIT, said)
        self.assertIn("1.332 kPa", said)

    def test_not_where_a_coupling_is_unstable(self):
        said = self.failure(PARTITIONED, NEO_HOOKEAN, 'partitioned.scheme="explicit"', "inlet.until=5", "time.end=2")
        self.assertNotIn("kPa at rest", said)

    def test_not_where_fibres_stiffen(self):
        said = self.failure(MONOLITHIC, ARTERY, "time.end=0.125", "newton.max_iterations=1")
        self.assertNotIn("kPa at rest", said)


if __name__ == "__main__":
    unittest.main()
