"""The artery made on demand and the same artery from a file of fsi-mesh, in every format, give the same run."""

import shutil
import unittest

from programs import (
    ARTERY,
    MESH,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    attempt,
    difference,
    execute,
    make_mesh,
    pressure,
    run,
    summary,
    wall,
)

FORMATS = {
    name: ("--format", name[:3], *(["--binary"] if "binary" in name else []))
    for name in ("4.1", "4.1-binary", "2.2", "2.2-binary")
}
SETTINGS = ("time.end=0.375", "output.every=0", "newton.tolerance=1e-11")


class MeshFiles(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.level = run(MONOLITHIC, ARTERY, cls.base / "level", *SETTINGS)
        cls.runs = {}
        for name, options in FORMATS.items():
            mesh = make_mesh(cls.base / f"{name}.msh", "--level", "coarse", *options)
            cls.runs[name] = run(MONOLITHIC, ARTERY, cls.base / name, f"mesh.file={mesh}", *SETTINGS)

    def test_all_formats_give_the_run_of_the_level(self):
        expected = summary(self.level)
        for name, folder in self.runs.items():
            with self.subTest(format=name):
                found = summary(folder)
                self.assertEqual(
                    {k: v for k, v in found["mesh"].items() if k not in ("name", "hash")},
                    {k: v for k, v in expected["mesh"].items() if k not in ("name", "hash")},
                )
                self.assertEqual(found["unknowns"], expected["unknowns"])
                # The order of the elements, and the last digit in text, may differ: rounding, times conditioning.
                apart = [
                    difference(pressure(folder), pressure(self.level)).max(),
                    difference(wall(folder)[:, :, 2], wall(self.level)[:, :, 2]).max(),
                ]
                print(f"{name} against level, pressure and wall:", apart)
                self.assertLess(max(apart), 1e-9)

    def test_versions_hold_the_same_numbers(self):
        for encoding in ("", "-binary"):
            self.assertSameTables(self.runs["4.1" + encoding], self.runs["2.2" + encoding])

    def test_file_is_found_beside_the_case(self):
        folder = self.base / "own"
        folder.mkdir()
        shutil.copy(self.base / "4.1.msh", folder / "tube.msh")
        case = folder / "case.toml"
        case.write_text(ARTERY.read_text().replace('level = "coarse"', 'file = "tube.msh"'))
        self.assertSameTables(run(MONOLITHIC, case, self.base / "beside", *SETTINGS), self.runs["4.1"])

    def test_quality_report_counts_what_the_run_counts(self):
        process = execute(MESH, "artery", "--level", "coarse", "-o", self.base / "report.msh")
        self.assertEqual(process.returncode, 0)
        mesh = summary(self.level)["mesh"]
        self.assertIn(f"{mesh['nodes']} nodes, {mesh['tetrahedra']} tetrahedra", process.stdout)

    def test_user_names_his_layers(self):
        text = (self.base / "2.2.msh").read_text()
        mesh, case = self.base / "named.msh", self.base / "named.toml"
        mesh.write_text(text.replace('"media"', '"inner layer"').replace('"adventitia"', '"sleeve"'))
        text = ARTERY.read_text()
        case.write_text(text.replace("layers.media", 'layers."inner layer"').replace("adventitia", "sleeve"))
        named = run(MONOLITHIC, case, self.base / "named", f"mesh.file={mesh}", *SETTINGS)
        self.assertLess(difference(pressure(named), pressure(self.level)).max(), 1e-9)

    def test_layer_that_the_mesh_lacks_is_refused(self):
        process = attempt(
            MONOLITHIC,
            NEO_HOOKEAN,
            folder=self.base / "refused",
            settings=("structure.layers.intima.material=neo-hookean", "structure.layers.intima.c10=1"),
        )
        self.assertEqual(process.returncode, 1)
        self.assertIn("intima", process.stderr)
        self.assertIn("media", process.stderr)
        self.assertFalse((self.base / "refused").exists())


if __name__ == "__main__":
    unittest.main()
