"""The error of mesh and step of a run: against the reference of the same case, and unknown where there is none."""

import json
import tomllib
import unittest

from folder_case import FolderCase

from fsi_research.catalogue.names import MATERIALS
from fsi_research.studies import FOLDER as READY
from fsi_research.evidence.mesh_error import error_table, error_words, mesh_error, percent, physical, references
from fsi_compare.runs.waves import WRITTEN
from fsi_compare.study.study_file import Method, Request, StudyMesh
from fsi_compare.study.study_run import DONE, StudyRun

ARTERY = READY.parents[2] / "meshes" / "artery"
METHOD = Method("monolithic", "monolithic", "fsi-monolithic", {})


class MeshErrors(FolderCase):
    def run_of(self, material="neo-hookean", factors=(1.0, 1.0), last=99.0, case=None, mesh="coarse", **settings):
        """A run with the reference's waves times the factors, until `last`."""
        folder = self.base / f"run-{len(list(self.base.iterdir()))}"
        folder.mkdir()
        for quantity, factor in zip(WRITTEN, factors):
            waves = references()["neo-hookean"].waves[quantity.column]
            lines = [f"time_ms,z_mm,{quantity.column}"]
            lines += [
                f"{t!r},{z!r},{factor * value!r}"
                for t, row in zip(waves.times.tolist(), waves.values.tolist())
                if t <= last
                for z, value in zip(waves.z.tolist(), row)
            ]
            (folder / quantity.file).write_text("\n".join(lines) + "\n")
        values = {key.replace("__", "."): value for key, value in settings.items()}
        case = case or ARTERY / f"{material}.toml"
        level = StudyMesh(mesh, mesh, ()) if mesh else None
        return StudyRun(Request("waves", material, METHOD, {}, case, level, values, 1.0), folder, DONE, "", 1.0, "")

    def test_the_ready_cases_have_references(self):
        for material in MATERIALS:
            case = tomllib.loads((ARTERY / f"{material}.toml").read_text())
            self.assertEqual(references()[material].case, physical(case), material)
            twin = tomllib.loads((ARTERY / "axisymmetric" / f"{material}.toml").read_text())
            self.assertEqual(references()[material].case, physical(twin), material)

    def test_an_axisymmetric_run_has_the_reference_of_the_tube(self):
        run = self.run_of(case=ARTERY / "axisymmetric" / "neo-hookean.toml", mesh=None, factors=(1.5, 1.25))
        self.assertAlmostEqual(mesh_error(run).pressure, 0.5, places=9)
        self.assertIn("no reference for geometry = plane", mesh_error(self.run_of(geometry="plane")).words)

    def test_a_wave_half_as_large_again_is_off_by_half(self):
        error = mesh_error(self.run_of(factors=(1.5, 0.75)))
        self.assertAlmostEqual(error.pressure, 0.5, places=9)
        self.assertAlmostEqual(error.displacement, 0.25, places=9)
        own = json.loads((READY / "references/neo-hookean/reference.json").read_text())["own_error"]
        self.assertEqual((error.own_pressure, error.own_displacement), (own["pressure_Pa"], own["radial_mm"]))
        self.assertEqual(error.words, "50 % in pressure, 25 % in radial displacement")

    def test_numerical_settings_do_not_matter(self):
        run = self.run_of(time__step=0.5, structure__stabilisation=0.05, monolithic__mode="full", output__every=0)
        self.assertEqual(mesh_error(run).pressure, 0.0)
        self.assertEqual(error_table([run], [mesh_error(run)]).rows[0][1], "coarse, stabilisation 0.05")

    def test_other_case_data_have_no_reference(self):
        for settings, word in (
            ({"structure__density": 1.2e-3}, "no reference for structure.density = 0.0012"),
            ({"inlet__until": 1.0}, "no reference for inlet.until = 1.0"),
            ({"structure__layers__media__fibre_scale": 0.5}, "no reference for structure.layers.media.fibre_scale"),
        ):
            error = mesh_error(self.run_of(**settings))
            self.assertIsNone(error.pressure)
            self.assertIn(word, error.words)
            self.assertTrue(error.words.startswith("unknown ("), error.words)

    def test_other_mesh_is_unknown(self):
        case = self.base / "own.toml"
        case.write_text((ARTERY / "neo-hookean.toml").read_text().replace('level = "coarse"', 'file = "tube.msh"'))
        self.assertIn(
            "its mesh is not one of the artery made on demand", mesh_error(self.run_of(case=case, mesh=None)).words
        )
        self.assertIn("not one of the artery", mesh_error(self.run_of(mesh__file="tube.msh")).words)
        self.assertEqual(mesh_error(self.run_of(mesh=None)).pressure, 0.0)  # the case file names a level itself

    def test_a_shorter_run_is_unknown(self):
        error = mesh_error(self.run_of(last=6.0))
        self.assertIn("the reference runs from 1.5 to 9 ms, this run from 1.5 to 6 ms", error.words)

    def test_missing_waves_are_unknown(self):
        run = self.run_of()
        (run.folder / "wall_displacement.csv").unlink()
        self.assertEqual(mesh_error(run).words, "unknown (wall_displacement.csv is missing or incomplete)")

    def test_words(self):
        half, other = (mesh_error(self.run_of(factors=factors)) for factors in ((1.5, 1.5), (1.1, 1.02)))
        self.assertEqual(error_words([("a", half), ("b", half)]), f"Error of mesh and step: {half.words}.")
        self.assertEqual(
            error_words([("a", half), ("b", other)]),
            "Error of mesh and step: a 50 % in pressure, 50 % in radial displacement; "
            "b 10 % in pressure, 2 % in radial displacement.",
        )
        self.assertEqual([percent(value) for value in (0.0213, 0.667, 1.234)], ["2.1 %", "67 %", "123 %"])

    def test_table(self):
        runs = [self.run_of(factors=(1.5, 1.25)), self.run_of(fluid__viscosity=1.0)]
        table = error_table(runs, [mesh_error(run) for run in runs])
        self.assertEqual(table.rows[0][:4], ["neo-Hookean", "coarse", "monolithic", "50"])
        self.assertEqual(table.rows[1][3:], ["unknown"] * 4)
        self.assertIn("unknown: no reference for fluid.viscosity = 1.0", table.notes)


if __name__ == "__main__":
    unittest.main()
