"""A package with builds for several x86-64 levels starts the best one for the processor; the real starter, in a tree of
stand-ins for the builds. A lesser processor is made of this one by hiding instructions from the C library, which the
starter asks."""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

SOURCES = Path(os.environ["FSI_SOURCES"])
CMAKE = os.environ["CMAKE_COMMAND"]
START = Path(os.environ["FSI_START_LEVEL"])
LEVELS = ("x86-64-v2", "x86-64-v3", "x86-64-v4")
NAME = "fsi-monolithic"
HIDE = {"x86-64-v4": "-AVX512BW", "x86-64-v3": "-AVX2", "x86-64-v2": "-SSE4_2"}  # an instruction that the level needs
sys.path.insert(0, str(SOURCES / "compare"))

from fsi_compare.starting.programs import find_program  # noqa: E402


# What hides instructions from the C library, or asks for a level: on a machine whose level is lowered it would reach the
# programs that are tried here.
for name in ("FSI_LEVEL", "GLIBC_TUNABLES"):
    os.environ.pop(name, None)


def levels_of_processor():
    """As the dynamic loader has them, which looks for libraries by level."""
    text = subprocess.run(["/lib64/ld-linux-x86-64.so.2", "--help"], capture_output=True, text=True, timeout=60).stdout
    return tuple(level for level in LEVELS if f"{level} (supported" in text)


AVAILABLE = levels_of_processor()


def make_script(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(textwrap.dedent(text))
    path.chmod(0o755)


def make_build(prefix, level):
    """A stand-in that says of what level it is and how it was called."""
    make_script(
        prefix / "lib" / "fsi-duo" / level / NAME,
        f"""\
        #!/bin/sh
        if [ "$1" = --version ]; then echo '{NAME} 0.1.0 ({level})'; exit; fi
        echo {level} "$@"
        exit 2
        """,
    )


class Starter(unittest.TestCase):
    def setUp(self):
        self.prefix = Path(tempfile.mkdtemp()) / "a prefix"
        self.addCleanup(shutil.rmtree, self.prefix.parent)
        self.program = self.prefix / "bin" / NAME
        self.program.parent.mkdir(parents=True)
        shutil.copy(START, self.program)
        for level in LEVELS:
            make_build(self.prefix, level)

    def start(self, *words, program=None, hidden=(), **environment):
        known = dict(os.environ)
        if hidden:
            known["GLIBC_TUNABLES"] = "glibc.cpu.hwcaps=" + ",".join(HIDE[level] for level in hidden)
        command = [program or self.program, *words]
        return subprocess.run(
            command, capture_output=True, text=True, timeout=60, cwd=self.prefix, env={**known, **environment}
        )

    def level(self, **how):
        process = self.start(**how)
        self.assertEqual((process.returncode, process.stderr), (2, ""))
        return process.stdout.strip()

    def refused(self, **how):
        process = self.start(**how)
        self.assertEqual((process.returncode, process.stdout), (1, ""))
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        return process.stderr.removesuffix("\n")


@unittest.skipIf(not AVAILABLE, "the processor is older than x86-64-v2")
class Levels(Starter):
    def test_best_of_the_processor(self):
        self.assertEqual(self.level(), AVAILABLE[-1])
        self.assertEqual(self.level(FSI_LEVEL=""), AVAILABLE[-1])

    def test_arguments_and_exit_code_are_handed_on(self):
        process = self.start("case file.toml", "", "-o", "a*")
        self.assertEqual((process.returncode, process.stdout), (2, f"{AVAILABLE[-1]} case file.toml  -o a*\n"))

    def test_lesser_processors(self):
        for i in range(1, len(AVAILABLE)):
            with self.subTest(AVAILABLE[i]):
                self.assertEqual(self.level(hidden=AVAILABLE[i:]), AVAILABLE[i - 1])
        # What a level needs is hidden; what a higher one needs is there, which makes no higher level of it.
        if len(AVAILABLE) == 3:
            self.assertEqual(self.level(hidden=AVAILABLE[1:2]), AVAILABLE[0])

    def test_every_instruction_of_a_level_counts(self):
        """One after the other is hidden, of those that the C library can hide."""
        needed = {
            "x86-64-v2": ("POPCNT", "SSSE3", "SSE4_1", "SSE4_2"),
            "x86-64-v3": ("AVX", "AVX2", "BMI1", "BMI2", "FMA", "LZCNT", "MOVBE"),
            "x86-64-v4": ("AVX512F", "AVX512BW", "AVX512CD", "AVX512DQ", "AVX512VL"),
        }
        for i, level in enumerate(AVAILABLE):
            for name in needed[level]:
                tunables = f"glibc.cpu.hwcaps=-{name}"
                with self.subTest(name):
                    ran = self.start(GLIBC_TUNABLES=tunables).stdout.strip()
                    self.assertEqual(ran, AVAILABLE[i - 1] if i > 0 else "")

    def test_level_can_be_lowered(self):
        for level in AVAILABLE:
            self.assertEqual(self.level(FSI_LEVEL=level), level)

    def test_best_that_is_present(self):
        shutil.rmtree(self.prefix / "lib" / "fsi-duo" / AVAILABLE[-1])
        if len(AVAILABLE) == 1:
            self.assertIn("No such file", self.refused())
        else:
            self.assertEqual(self.level(), AVAILABLE[-2])
            self.assertEqual(self.level(FSI_LEVEL=AVAILABLE[-1]), AVAILABLE[-2])

    def test_nothing_present(self):
        shutil.rmtree(self.prefix / "lib")
        lowest = f"{self.prefix}/bin/../lib/fsi-duo/x86-64-v2/{NAME}"
        expected = f"{NAME}: error: {lowest}: cannot be started: No such file or directory"
        self.assertEqual(self.refused(), f"{expected}; install the package fsi-duo again")

    def test_build_that_cannot_be_started(self):
        """Is said: another level would hide a damaged installation."""
        (self.prefix / "lib" / "fsi-duo" / AVAILABLE[-1] / NAME).chmod(0o644)
        self.assertIn(f"{AVAILABLE[-1]}/{NAME}: cannot be started: Permission denied; ", self.refused())

    def test_unknown_level(self):
        available = ", ".join(AVAILABLE[:-1]) + " or " + AVAILABLE[-1] if len(AVAILABLE) > 1 else AVAILABLE[0]
        for wanted, shown in (
            ("v3", "v3"),
            ("x86-64-v30", "x86-64-v30"),
            ("x\033[2J\ny", "x?[2J?y"),
            ("a" * 300, "a" * 200),
        ):
            self.assertEqual(
                self.refused(FSI_LEVEL=wanted),
                f"{NAME}: error: FSI_LEVEL: '{shown}' is no level of x86-64 processors; leave it out, or give {available}",
            )

    def test_level_that_the_processor_lacks(self):
        for i in range(1, len(AVAILABLE)):
            message = self.refused(FSI_LEVEL=AVAILABLE[i], hidden=AVAILABLE[i:])
            self.assertIn(f"FSI_LEVEL: '{AVAILABLE[i]}' is a level that this processor does not have; ", message)
            self.assertNotIn(AVAILABLE[i], message.split(";")[1])

    def test_older_processor(self):
        message = self.refused(hidden=AVAILABLE)
        self.assertIn("this processor lacks the instructions of x86-64-v2; ", message)

    def test_called_by_links_and_by_the_path(self):
        elsewhere = self.prefix.parent / "elsewhere"
        elsewhere.mkdir()
        (elsewhere / "solve").symlink_to(self.program)
        self.assertEqual(self.level(program=elsewhere / "solve"), AVAILABLE[-1])
        self.assertEqual(self.level(program=f"bin/{NAME}"), AVAILABLE[-1])  # from the folder above
        path = f"{self.program.parent}:{os.environ['PATH']}"
        process = self.start(NAME, program="/usr/bin/env", PATH=path)
        self.assertEqual(process.stdout.strip(), AVAILABLE[-1])

    def test_same_process_with_its_signals(self):
        """Who kills the program that was started ends the one that computes; blocked signals stay blocked."""
        make_script(
            self.prefix / "lib" / "fsi-duo" / AVAILABLE[-1] / NAME,
            f"#!{sys.executable} -ES\nimport os, signal\nsignal.signal(signal.SIGINT, signal.SIG_DFL)\n"
            "print(os.getpid(), signal.SIGTERM in signal.pthread_sigmask(signal.SIG_BLOCK, ()), flush=True)\n"
            "signal.pause()\n",
        )
        blocked = lambda: signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})  # noqa: E731
        environment = {name: value for name, value in os.environ.items() if name != "FSI_LEVEL"}
        with subprocess.Popen([self.program], stdout=subprocess.PIPE, preexec_fn=blocked, env=environment) as process:
            try:
                self.assertEqual(process.stdout.readline().split(), [b"%d" % process.pid, b"True"])
            finally:
                process.send_signal(signal.SIGINT)
        self.assertEqual(process.returncode, -signal.SIGINT)

    def test_compare_knows_the_build_that_runs(self):
        """The starter is the same for every version, so that a run is told by the build behind it."""
        found = find_program(NAME, self.program)
        build = self.prefix / "lib" / "fsi-duo" / AVAILABLE[-1] / NAME
        self.assertEqual((found.path, found.version), (self.program, "0.1.0"))
        self.assertEqual(found.digest, hashlib.sha256(build.read_bytes()).hexdigest())
        # Without builds beside it, a program that names its level is itself what runs.
        alone = self.prefix.parent / "alone" / NAME
        alone.parent.mkdir()
        shutil.copy(build, alone)
        self.assertEqual(find_program(NAME, alone).digest, hashlib.sha256(alone.read_bytes()).hexdigest())


class Installed(unittest.TestCase):
    """cmake/Levels.cmake, in a project of small programs."""

    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)
        (self.scratch / "main.c").write_text('#include <stdio.h>\nint main(void) { return puts("x86-64-v2") < 0; }\n')
        (self.scratch / "CMakeLists.txt").write_text(
            textwrap.dedent(
                f"""\
                cmake_minimum_required(VERSION 3.22)
                project(trial VERSION 1.2 LANGUAGES C)
                set(FSI_ARCH "" CACHE STRING "")
                set(FSI_MPI ON CACHE BOOL "")
                set(FSI_TESTS ON)
                set(_drivers fsi-monolithic fsi-partitioned)
                foreach(name IN LISTS _drivers)
                  add_executable(${{name}} main.c)
                endforeach()
                add_subdirectory({SOURCES}/packages packages)
                include({SOURCES}/cmake/Levels.cmake)
                """
            )
        )
        self.environment = {name: value for name, value in os.environ.items() if name != "FSI_LEVEL"}

    def make_other(self, folder, level, version="1.2", mpi="ON"):
        other = self.scratch / folder
        for name in (NAME, "fsi-partitioned"):
            make_script(other / "bin" / name, f"#!/bin/sh\necho {level}\n")
        (other / "CMakeCache.txt").write_text(
            f"FSI_ARCH:STRING={level}\nCMAKE_PROJECT_VERSION:STATIC={version}\nFSI_MPI:BOOL={mpi}\n"
        )
        return other

    def cmake(self, *words):
        command = [CMAKE, *(str(word) for word in words)]
        return subprocess.run(command, capture_output=True, text=True, timeout=300)

    def configure(self, level, *others):
        levels = ";".join(str(other) for other in others)
        build = self.scratch / "build"
        return self.cmake("-S", self.scratch, "-B", build, f"-DFSI_ARCH={level}", f"-DFSI_PACKAGE_LEVELS={levels}")

    def test_tree_of_three_levels(self):
        process = self.configure("x86-64-v2", self.make_other("v3", "x86-64-v3"), self.make_other("v4", "x86-64-v4"))
        self.assertEqual(process.returncode, 0, process.stderr)
        for words in (
            ("--build", self.scratch / "build"),
            ("--install", self.scratch / "build", "--prefix", self.scratch / "to"),
        ):
            process = self.cmake(*words)
            self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        files = {
            str(path.relative_to(self.scratch / "to")) for path in (self.scratch / "to").rglob("*") if path.is_file()
        }
        drivers = (NAME, "fsi-partitioned")
        expected = {f"bin/{name}" for name in drivers}
        expected |= {f"lib/fsi-duo/{level}/{name}" for level in LEVELS for name in drivers}
        self.assertEqual(files, expected)
        for name in drivers if AVAILABLE else ():
            for level in AVAILABLE:
                program = self.scratch / "to" / "bin" / name
                environment = {**self.environment, "FSI_LEVEL": level}
                process = subprocess.run([program], capture_output=True, text=True, timeout=60, env=environment)
                self.assertEqual((process.returncode, process.stdout, process.stderr), (0, f"{level}\n", ""))

    def test_builds_that_do_not_go_together(self):
        v3 = self.make_other("v3", "x86-64-v3")
        for level, others, shown in (
            ("x86-64-v2", [self.scratch / "nothing"], "is no build folder"),
            ("x86-64-v2", [self.make_other("znver5", "znver5")], "built for FSI_ARCH='znver5', which is no level"),
            ("x86-64-v2", [v3, self.make_other("again", "x86-64-v3")], "is the second build for x86-64-v3"),
            (
                "x86-64-v2",
                [self.make_other("older", "x86-64-v3", version="1.1")],
                "has CMAKE_PROJECT_VERSION=1.1, this",
            ),
            ("x86-64-v2", [self.make_other("serial", "x86-64-v3", mpi="OFF")], "has FSI_MPI=OFF, this build ON"),
            ("x86-64-v4", [v3], "for the lowest level, x86-64-v2, not x86-64-v4"),
        ):
            with self.subTest(shown):
                process = self.configure(level, *others)
                self.assertNotEqual(process.returncode, 0)
                self.assertIn(shown, " ".join(process.stderr.split()))


if __name__ == "__main__":
    unittest.main()
