"""`fsi-compare tune`: targets that contradict themselves or the case are one clear line."""

import types
import unittest
from pathlib import Path

from folder_case import FolderCase

from fsi_compare.tune.command import mesh_of_beats

CASE = """\
title = "A fork"
[mesh]
level = "coarse"
[fluid]
density = 1.0
viscosity = 3.5e-3
[[opening]]
surface = "inlet"
flow_rate = [[0, 1], [100, 5], [800, 1]]
period = 800
[[opening]]
surface = "left"
windkessel = { proximal = 0.1, compliance = 100, distal = 1 }
[[opening]]
surface = "right"
windkessel = { proximal = 0.1, compliance = 100, distal = 1, distal_pressure = 2.0 }
[time]
step = 10
end = 800
"""
PRESSURE = "inlet=80/120mmHg"


class TuneInput(FolderCase):
    def refused(self, words, message, case=CASE, targets=None):
        path = self.base / "fork.toml"
        path.write_text(case)
        if targets is not None:
            (self.base / "targets.toml").write_text(targets)
            words = [*words, "--targets", self.base / "targets.toml"]
        code, out, err = self.call("tune", path, "-o", self.out, *words)
        self.assertEqual((code, out), (1, ""), err)
        self.assertIn(message, err)
        self.assertEqual(err.count("\n"), 1, err)
        self.assertTrue(err.startswith("fsi-compare: error: "), err)
        self.assertFalse(self.out.exists())

    def test_pressures(self):
        for text, message in (
            ("inlet=120/80mmHg", "--pressure: the diastolic pressure 120 is not below the systolic one 80"),
            ("inlet=80/120", "'80/120' has no unit; give kPa or mmHg, like inlet=80/120mmHg"),
            ("inlet=80/120kPa", "80 kPa is 600 mmHg, more than any artery has; was it mmHg?"),
            ("inlet=8/12bar", "'bar' is no unit of pressure here"),
            ("inlet=0/12kPa", "a pressure of 0 kPa is not positive"),
            ("inlet=80mmHg", "'80mmHg' is no diastolic and systolic pressure"),
            ("80/120mmHg", "names no opening and value"),
            ("outlet=80/120mmHg", "'outlet' is no opening; did you mean"),
            ("inlet=1/1.5kPa", "the systolic pressure of 1.5 kPa is not above the distal_pressure of right, 2 kPa"),
        ):
            with self.subTest(text):
                self.refused(["--pressure", text], message)
        self.refused(["--pressure", PRESSURE, "--pressure", "inlet=70/110mmHg"], "of 'inlet' is given twice")
        self.refused(["--pressure", PRESSURE, "--mean-pressure", "left=90mmHg"], "3 pressures are given")
        self.refused(["--split", "left=60%"], "--pressure: is missing")
        self.refused(["--flow", "left=1ml/s", "--flow", "right=1ml/s"], "--pressure: is missing")

    def test_flows(self):
        for words, message in (
            (["--split", "left=60%", "--split", "right=50%"], "--split: the shares are 110 % together; give 100 %"),
            (["--split", "left=60%", "--split", "right=30%"], "--split: the shares are 90 % together; give 100 %"),
            (["--split", "left=160%"], "'160%' is no part of the flow"),
            (
                ["--split", "inlet=60%"],
                "'inlet' has no Windkessel, so that its flow cannot be tuned; those with one: left",
            ),
            (["--split", "left=60%", "--flow", "right=2ml/s"], "give shares or flows, not both"),
            (["--flow", "right=2ml/s"], "--flow: is missing for left; name all outlets with a Windkessel, or none"),
            (["--flow", "right=2mmHg"], "'2mmHg' is no flow outwards; give a positive one in ml/s"),
            (["--flow", "right=-2ml/s"], "'-2ml/s' is no flow outwards"),
        ):
            with self.subTest(words):
                self.refused(["--pressure", PRESSURE, *words], message)

    def test_options(self):
        for words, message in (
            (["--driver", "both"], "--driver: 'both' is no driver"),
            (["--beats", "0"], "--beats: 0 beats will not do; give 1 to 10"),
            (["--proximal", "150%"], "--proximal: 150% is no part of a value"),
            (["--tolerance", "small"], "--tolerance: small is no part of a value"),
            (["--time-limit", "nan"], "--time-limit: nan s is no time; give a positive number of seconds"),
            (["--time-limit", "-3"], "--time-limit: -3 s is no time"),
        ):
            with self.subTest(words):
                self.refused(["--pressure", PRESSURE, *words], message)

    def test_tables_of_targets(self):
        for text, message in (
            ("[presure]\ninlet = '80/120mmHg'", "presure: is unknown; did you mean 'pressure'?"),
            ("[pressure]\ninlet = 80", 'pressure.inlet: is not a text; give one like "80/120mmHg"'),
            ("[pressure]\ninlet = '80/120'", "pressure.inlet: '80/120' has no unit"),
            ("pressure = '80/120mmHg'", "pressure: is no section"),
        ):
            with self.subTest(text):
                self.refused([], message, targets=text)

    def test_cases(self):
        for old, new, message in (
            ("period = 800\n", "", "nothing repeats itself, so that there is no beat"),
            ("distal = 1 }", "distal = 1 }\nperiod = 700", "periods of 700 and 800 ms have no beat in common"),
            ("flow_rate = [[0, 1], [100, 5], [800, 1]]", "pressure = 1.0", "'inlet' has its pressure from the case"),
            ("[time]\nstep = 10\nend = 800", "[static]", "time: is missing, and a beat takes some"),
            ("distal = 1 }", 'distal = "1" }', "opening.left.windkessel.distal: is no number from 0 on"),
            ("windkessel", "resistance = 1.0 #", "none has a Windkessel"),
            ("distal_pressure = 2.0", 'distal_pressure = "2"', "right.windkessel.distal_pressure: is no number; give"),
            ("windkessel", 'resistance = "1" #', "opening.left.resistance: is no number; give one"),
        ):
            with self.subTest(new):
                self.assertIn(old, CASE)
                self.refused(["--pressure", PRESSURE], message, CASE.replace(old, new, 1 if "left" in message else -1))
        self.refused(["--pressure", PRESSURE], "not a network", CASE + "[network]\n")
        self.refused(
            ["--pressure", PRESSURE], "windkessel4: is not tuned", CASE.replace("windkessel =", "windkessel4 =")
        )
        missing = ["--pressure", PRESSURE, "--monolithic", Path("nowhere", "fsi-monolithic")]
        path = self.base / "fork.toml"
        path.write_text(CASE)
        code, _, err = self.call("tune", path, "-o", self.out, *missing)
        self.assertEqual(code, 1)
        self.assertIn("no such program", err)
        self.assertFalse(self.out.exists())

    def test_missing_mesh_is_made_by_the_script_as_it_stands(self):
        """Of `size = 0.25 * radius` no number is taken; no size is needed, since the mesh stays as it is."""
        script = self.base / "fork.geo"
        script.write_text("DefineConstant[ radius = 2, size = 0.25 * radius ];\nMesh.MeshSizeMax = size;\n")
        case = self.base / "fork.toml"
        entries = {"element": "p1", "mesh": {"file": "fork.msh"}}
        mesh = mesh_of_beats(types.SimpleNamespace(path=case, entries=entries), None, Path("fsi-mesh"), self.out)
        self.assertEqual((mesh.command, mesh.options), ("geo", (str(script),)))


if __name__ == "__main__":
    unittest.main()
