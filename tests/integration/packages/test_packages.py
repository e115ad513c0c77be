"""`cpack -G DEB` makes two Debian packages of what is built: read with dpkg-deb, and started from where they unpack."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

BUILD = Path(os.environ["FSI_BUILD"])
VERSION, SAID_VERSION = os.environ["FSI_VERSION"], os.environ["FSI_SAID_VERSION"]
ARCH = os.environ["FSI_ARCH"]
NATIVE, MPI = (os.environ[name] == "1" for name in ("FSI_NATIVE", "FSI_MPI"))


def execute(*command, **options):
    """Output of a command that must end well."""
    process = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=500, **options)
    if process.returncode != 0:
        raise AssertionError(
            f"{' '.join(map(str, command))}\nends with {process.returncode}:\n" f"{process.stdout}{process.stderr}"
        )
    return process.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.scratch)
        execute(os.environ["CPACK_COMMAND"], "-G", "DEB", "-B", cls.scratch, cwd=BUILD)
        architecture = execute("dpkg", "--print-architecture").strip()
        cls.programs, cls.development = (
            cls.scratch / f"{name}_{VERSION}_{architecture}.deb" for name in ("fsi-duo", "fsi-duo-dev")
        )

    def field(self, package, name):
        return execute("dpkg-deb", "--field", package, name).strip()

    def contents(self, package):
        """Paths of the files, without folders."""
        lines = execute("dpkg-deb", "--contents", package).splitlines()
        return {line.split(maxsplit=5)[5].removeprefix(".") for line in lines if not line.startswith("d")}

    def test_metadata(self):
        for package, name, section in (
            (self.programs, "fsi-duo", "science"),
            (self.development, "fsi-duo-dev", "libdevel"),
        ):
            with self.subTest(name):
                self.assertEqual(self.field(package, "Package"), name)
                self.assertEqual(self.field(package, "Version"), VERSION)
                self.assertEqual(self.field(package, "Section"), section)
                self.assertRegex(self.field(package, "Maintainer"), r".+ <.+@.+>")

    def test_description_says_for_which_machines(self):
        for package in (self.programs, self.development):
            description = self.field(package, "Description")
            self.assertTrue(description.startswith("fluid-structure interaction"))
            # Every further line begins with one blank; an empty one is " .".
            for line in description.splitlines()[1:]:
                self.assertRegex(line, r"^ (\.|\S.*)$")
            self.assertEqual("may not start on another one" in description, NATIVE and not ARCH, description)
            self.assertEqual("does not start on others" in description, bool(ARCH), description)
            if ARCH:
                self.assertIn(ARCH, description)

    def test_programs_depend_on_what_they_need(self):
        depends = {re.split(r"[ (]", word.strip())[0] for word in self.field(self.programs, "Depends").split(",")}
        modules = ("", "-matplotlib", "-numpy", "-h5py", "-jinja2", "-meshio", "-netcdf4")
        self.assertLessEqual({f"python3{module}" for module in modules} | {"libjs-three"}, depends)
        # Found by dpkg-shlibdeps, under names that carry a version.
        libraries = ["libc6", "libgmsh", "libhdf5", "libumfpack", "libopenblas", "libspdlog", "libfmt"]
        if MPI:
            libraries += ["libhdf5-openmpi", "libopenmpi", "libptscotch"]
            self.assertLessEqual({"openmpi-bin", "openssh-client"}, depends)  # mpirun
        for library in libraries:
            self.assertTrue(any(name.startswith(library) for name in depends), f"{library} not in {depends}")

    def test_libraries_depend_on_the_headers_they_include(self):
        depends = self.field(self.development, "Depends")
        for package in ("libeigen3-dev", "libfmt-dev", "nlohmann-json3-dev", "libtomlplusplus-dev", "zlib1g-dev"):
            self.assertIn(package, depends)
        for package in ("libhdf5-openmpi-dev", "libopenmpi-dev", "petsc-dev") if MPI else ("libhdf5-dev",):
            self.assertIn(package, depends)

    def test_contents(self):
        programs, development = self.contents(self.programs), self.contents(self.development)
        self.assertLessEqual(
            {
                "/usr/bin/fsi-mesh",
                "/usr/bin/fsi-monolithic",
                "/usr/bin/fsi-partitioned",
                "/usr/bin/fsi-compare",
                "/usr/bin/fsi-python",
                "/usr/lib/python3/dist-packages/fsi-duo.pth",
                "/usr/share/fsi-duo/compare/fsi_compare/py.typed",
                "/usr/share/fsi-duo/compare/fsi_compare/cli.py",
                "/usr/share/fsi-duo/compare/fsi_compare/reporting/templates/report.html.j2",
                "/usr/share/fsi-duo/compare/studies/refinement.toml",
                "/usr/share/fsi-duo/gallery/known_solutions/turek_hron.py",
                "/usr/share/fsi-duo/slurm/fsi-duo.sbatch",
                "/usr/share/fsi-duo/meshes/artery/neo-hookean.toml",
                "/usr/share/doc/fsi-duo/copyright",
                "/usr/share/doc/fsi-duo/README.md",
            },
            programs,
        )
        self.assertLessEqual(
            {
                "/usr/include/fsi-duo/base/version.hpp",
                "/usr/include/fsi-duo/monolithic/linear_solvers.hpp",
                "/usr/lib/libfsi_base.a",
                "/usr/lib/cmake/fsi-duo/fsi-duo-config.cmake",
            },
            development,
        )
        self.assertEqual(programs & development, set())
        strays = [
            path
            for path in programs | development
            if re.search(r"__pycache__|/compare/research/|\.msh$|/tests?/|\.in$", path)
        ]
        self.assertEqual(strays, [])

    def test_unpacked_programs_start(self):
        folder = self.scratch / "unpacked"
        execute("dpkg-deb", "--extract", self.programs, folder)
        for name, said in (
            ("fsi-mesh", SAID_VERSION),
            ("fsi-monolithic", SAID_VERSION),
            ("fsi-partitioned", SAID_VERSION),
            ("fsi-compare", VERSION),
        ):
            self.assertEqual(execute(folder / "usr" / "bin" / name, "--version"), f"{name} {said}\n")


if __name__ == "__main__":
    unittest.main()
