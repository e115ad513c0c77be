"""scripts/install_packages.sh on machines that have other things: with stand-ins for apt and dpkg."""

import os
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[3] / "scripts"

# What the stand-ins know: a file per package that holds its state.
DPKG_QUERY = r"""#!/bin/sh
cd "$MACHINE/packages" || exit 1
case "$*" in
  *Package*) for p in *; do [ -e "$p" ] && echo "$(cat "$p") $p"; done; true ;;
  *) for last; do :; done; cat "$last" 2>/dev/null || exit 1 ;;
esac
"""
APT_CACHE = r"""#!/bin/sh
[ "$2" = python3-paraview ] && echo "Conflicts: python3-vtk9"
exit 0
"""
APT_GET = r"""#!/bin/sh
echo "$*" >> "$MACHINE/calls"
case "$*" in *update*) exit 0 ;; esac
for word; do
  case "$word" in
    -*|install) ;;
    python3-paraview) [ -e "$MACHINE/packages/python3-vtk9" ] && { echo "E: Packages need to be removed but remove is disabled." >&2; exit 100; } ;;
  esac
done
case "$*" in *--simulate*) exit 0 ;; esac
for word; do
  case "$word" in -*|install) ;; *) echo installed > "$MACHINE/packages/$word" ;; esac
done
"""
ID = '#!/bin/sh\necho "$USER_NUMBER"\n'
SUDO = "#!/bin/sh\nexit 1\n"


class InstallStep(unittest.TestCase):
    def setUp(self):
        self.machine = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.machine)
        self.packages, programs = self.machine / "packages", self.machine / "bin"
        self.packages.mkdir()
        programs.mkdir()
        stand_ins = {"dpkg-query": DPKG_QUERY, "apt-get": APT_GET, "apt-cache": APT_CACHE, "id": ID, "sudo": SUDO}
        for name, text in stand_ins.items():
            (programs / name).write_text(text)
            (programs / name).chmod(stat.S_IRWXU)

    def has(self, *packages, state="installed"):
        for package in packages:
            (self.packages / package).write_text(state + "\n")

    def wanted(self, *lists):
        lines = [line.split("#")[0].split() for name in lists for line in (SCRIPTS / name).read_text().splitlines()]
        return [words[0] for words in lines if words]

    def install(self, *options, user=0, ci=False):
        environment = {
            "PATH": f"{self.machine / 'bin'}:{os.environ['PATH']}",
            "MACHINE": str(self.machine),
            "USER_NUMBER": str(user),
            "CI": "true" if ci else "",
        }
        command = ["bash", SCRIPTS / "install_packages.sh", *options]
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        return done.returncode, done.stdout, done.stderr

    def calls(self):
        file = self.machine / "calls"
        return file.read_text().splitlines() if file.exists() else []

    def test_a_bare_machine_gets_all_and_the_second_call_nothing(self):
        code, _, errors = self.install("--tests")
        self.assertEqual((code, errors), (0, ""))
        for package in self.wanted("packages.txt", "packages-test.txt"):
            self.assertTrue((self.packages / package).exists(), package)
        calls = len(self.calls())
        self.assertEqual(self.install("--tests", user=1000), (0, "", ""))
        self.assertEqual(len(self.calls()), calls)

    def test_a_package_that_something_here_excludes_is_left_out_and_said(self):
        self.has("python3-vtk9")
        code, said, errors = self.install("--tests")
        self.assertEqual((code, errors), (0, ""))
        self.assertIn(
            "left out python3-paraview and the tests that need it: it excludes python3-vtk9, which is installed", said
        )
        self.assertFalse((self.packages / "python3-paraview").exists())
        self.assertTrue((self.packages / "clang-tidy").exists())
        # Again, also by who may not install anything: nothing else is missing.
        code, said, errors = self.install("--tests", user=1000)
        self.assertEqual((code, errors, said.count("\n")), (0, "", 1))

    def test_continuous_integration_leaves_nothing_out(self):
        self.has("python3-vtk9")
        code, _, errors = self.install("--tests", ci=True)
        self.assertEqual(code, 1)
        self.assertIn("error: python3-paraview cannot be installed: it excludes python3-vtk9", errors)

    def test_nothing_is_ever_removed(self):
        self.install("--tests")
        installs = [call for call in self.calls() if "install" in call.split()]
        self.assertTrue(installs)
        for call in installs:
            self.assertIn("--no-remove", call)

    def test_a_package_of_another_origin_that_is_half_done_is_named(self):
        self.has("vendor-driver", state="half-configured")
        code, _, errors = self.install()
        self.assertEqual(code, 1)
        self.assertIn("packages on this machine are half done: vendor-driver (half-configured)", errors)
        self.assertIn("dpkg --configure -a", errors)

    def test_who_may_not_install_is_told_what_is_missing(self):
        self.has(*self.wanted("packages.txt"))
        (self.packages / "cmake").unlink()
        code, _, errors = self.install(user=1000)
        self.assertEqual(code, 1)
        self.assertIn("missing packages: cmake", errors)


if __name__ == "__main__":
    unittest.main()
