"""scripts/fresh_machine.sh as far as it goes without making a machine: its arguments, its table of stages, the processor
levels, and what it reads of containers/Containerfile."""

import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
SCRIPT, PARTS = TOP / "scripts" / "fresh_machine.sh", TOP / "scripts" / "fresh_machine"
CONTAINERFILE = TOP / "containers" / "Containerfile"

sys.path.insert(0, str(PARTS))
import containerfile  # noqa: E402

# Programs that the script may call before it begins.
NEEDED = "basename bash dirname dpkg-deb git grep ls mkdir mktemp python3 realpath sed tar unshare".split()


def output(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=100, **options)


class ScratchTest(unittest.TestCase):
    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)


class Arguments(ScratchTest):
    """What is refused before anything is made."""

    def refused(self, *arguments, user=0, missing=()):
        """The one line that says why. `user`: the number that `id` gives; `missing`: programs that are not there."""
        programs, temporary = self.scratch / "bin", self.scratch / "tmp"
        shutil.rmtree(programs, ignore_errors=True)
        programs.mkdir()
        temporary.mkdir(exist_ok=True)
        for program in NEEDED:
            if program not in missing:
                (programs / program).symlink_to(shutil.which(program) or program)
        stand_ins = {"id": f"echo {user}", "mmdebstrap": 'echo "was called" >&2; exit 1'}
        for name, text in stand_ins.items():
            if name not in missing:
                (programs / name).write_text(f"#!/bin/sh\n{text}\n")
                (programs / name).chmod(stat.S_IRWXU)
        environment = {"PATH": str(programs), "TMPDIR": str(temporary)}
        log = self.scratch / "log"
        done = output("/bin/bash", SCRIPT, "--log", log, *arguments, env=environment, cwd=self.scratch)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(list(temporary.iterdir()), [])
        self.assertFalse(log.exists())
        self.assertTrue(done.stderr.startswith("fresh_machine.sh: error: "), done.stderr)
        return done.stderr

    def test_options(self):
        self.assertIn("unknown option '--levels'", self.refused("--levels"))
        self.assertIn("--level needs a value", self.refused("--level"))
        self.assertIn("--level v5: the levels are v2, v3 and v4", self.refused("--level", "v5"))
        self.assertIn("--container beside --short", self.refused("--short", "--container"))
        self.assertIn("--serial beside --short", self.refused("--short", "--serial"))
        self.assertIn("--arm beside --short", self.refused("--short", "--arm"))
        self.assertIn("--level beside --arm", self.refused("--container", "--arm", "--level", "v2"))
        self.assertIn("two folders, a and b", self.refused("a", "b"))
        self.assertIn("--debs nowhere: there is no such folder", self.refused("--debs", "nowhere"))
        self.assertIn("--ccache nowhere: there is no such folder", self.refused("--ccache", "nowhere"))

    def test_a_folder_with_something_in_it(self):
        folder = self.scratch / "machine"
        folder.mkdir()
        (folder / "mine").write_text("kept")
        self.assertIn("is there and not empty", self.refused(folder))
        self.assertEqual((folder / "mine").read_text(), "kept")

    def test_a_package_that_is_none(self):
        file = self.scratch / "fsi-duo.deb"
        self.assertIn("this is no Debian package", self.refused("--package", file))
        file.write_text("no package")
        self.assertIn("this is no Debian package", self.refused("--package", file))

    def test_who_is_not_root_and_what_is_not_there(self):
        self.assertIn("needs root", self.refused(user=1000))
        self.assertIn("install the Debian package mmdebstrap", self.refused(missing=["mmdebstrap"]))
        self.assertIn("install the Debian package git", self.refused(missing=["git"]))

    def test_help_says_every_option(self):
        done = output("bash", SCRIPT, "--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        known = set(re.findall(r"--[a-z-]+(?= *[|)])", SCRIPT.read_text().split("case")[1] + SCRIPT.read_text()))
        self.assertGreaterEqual(len(known), 10)
        for option in known:
            self.assertRegex(done.stdout, rf"(?m)^ *{option}\b", option)
        self.assertNotIn("set -euo", done.stdout)


class Table(ScratchTest):
    def run_stages(self, stages):
        """A script with these stages: its exit code, output, and log."""
        (self.scratch / "machine").mkdir()
        script = f"""set -euo pipefail
            log={self.scratch}/log measured={self.scratch}/machine not_measured=elsewhere
            . {PARTS}/table.sh
            trap report_failure EXIT
            {stages}
            print_table"""
        done = output("bash", "-c", script, cwd=self.scratch / "machine")
        return done.returncode, done.stdout, done.stderr, (self.scratch / "log").read_text()

    def test_rows(self):
        code, said, errors, log = self.run_stages(
            """
            stage "writes" bash -c 'echo some words; head -c 5M /dev/urandom > file'
            stage "mounts" bash -c 'mkdir elsewhere; head -c 9M /dev/urandom > elsewhere/file'
            stage "computes" python3 -c 'import time
while time.process_time() < 1: pass'
            stage "removes" rm file"""
        )
        self.assertEqual((code, errors), (0, ""))
        table = said.split("\n\n")[1].splitlines()
        self.assertEqual(table[0].split(), ["stage", "seconds", "processor", "s", "disk", "MiB"])
        rows = {line.split()[0]: [float(word) for word in line.split()[1:]] for line in table[1:]}
        self.assertEqual(list(rows), ["writes", "mounts", "computes", "removes"])
        self.assertEqual([rows[name][2] for name in rows], [5, 0, 0, -5])
        self.assertGreaterEqual(rows["computes"][1], 0.9)  # of the processor's seconds; tenths are cut off
        self.assertIn("some words", log)
        self.assertNotIn("some words", said)

    def test_stages_of_a_script_within_the_last_one(self):
        quickstart = (TOP / "scripts" / "quickstart.sh").read_text()
        row = re.search(r"printf ('%-24s [^']*')", quickstart).group(1)
        code, said, errors, _ = self.run_stages(
            f"""
            stage "before" printf {row}'\\n' "of another" 1 2
            stage "now" bash -c "echo '== mesh'; printf {row}'\\n' packages 12 3 'monolithic run' 1234 5"
            print_own_stages"""
        )
        self.assertEqual((code, errors), (0, ""))
        expected = ["  packages                     12.3 s", "  monolithic run             1234.5 s"]
        self.assertEqual(said.split("== now\n")[1].splitlines()[:2], expected)
        self.assertNotIn("another", said)

    def test_a_stage_that_fails_is_named_with_the_end_of_its_output(self):
        code, said, errors, _ = self.run_stages(
            """
            stage "good" true
            stage "bad" bash -c 'echo the reason; exit 7'
            stage "never" true"""
        )
        self.assertEqual((code, errors), (7, "error: failed in the stage 'bad'\n"))
        self.assertIn("the reason", said)
        self.assertRegex(said, r"(?m)^good  ")
        self.assertNotIn("never", said)

    def test_what_fails_between_stages_is_no_silent_end(self):
        code, _, errors, _ = self.run_stages(
            """
            stage "good" true
            false"""
        )
        self.assertEqual((code, errors), (1, "error: failed after the stage 'good'\n"))


class Level(unittest.TestCase):
    LOADER = "/lib64/ld-linux-x86-64.so.2"

    def settings(self, level):
        done = output("bash", "-euc", f". {PARTS}/level.sh; level_environment '{level}'")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return dict(line.split("=", 1) for line in done.stdout.splitlines())

    def supported(self, settings):
        text = output(self.LOADER, "--help", env={**os.environ, **settings}).stdout
        return set(re.findall(r"x86-64-(v\d) \(supported", text))

    def test_no_level_changes_nothing(self):
        self.assertEqual(self.settings(""), {})

    def test_libraries_see_no_higher_level(self):
        for level in ("v4", "v3", "v2"):
            with self.subTest(level):
                settings = self.settings(level)
                self.assertEqual(settings["FSI_ARCH"], f"x86-64-{level}")
                self.assertEqual(self.supported(settings), {have for have in self.supported({}) if have <= level})

    def test_registers_beyond_a_level_are_counted(self):
        code = "vaddpd %zmm0,%zmm1,%zmm2\nvaddpd %ymm0,%ymm1,%ymm2\naddpd %xmm0,%xmm1\n"
        for level, count in (("v2", 2), ("v3", 1), ("", 1)):
            done = output("bash", "-euc", f". {PARTS}/level.sh; registers_beyond '{level}'", input=code)
            self.assertEqual((done.returncode, done.stdout), (0, f"{count}\n"), level)
        done = output("bash", "-euc", f". {PARTS}/level.sh; registers_beyond v3", input="ret\n")
        self.assertEqual((done.returncode, done.stdout), (0, "0\n"))


class Configuration(ScratchTest):
    """FSI_ARCH of the environment is what a first configuration takes, where nothing else is said."""

    def flags(self, folder, *options, level="x86-64-v2"):
        configure = ["cmake", "-S", TOP, "-B", self.scratch / folder, "-DFSI_TESTS=OFF", "-DFSI_MPI=OFF", *options]
        done = output(*configure, env={**os.environ, "FSI_ARCH": level})
        self.assertEqual(done.returncode, 0, done.stderr)
        return set(re.findall(r"-march=(\S+)", (self.scratch / folder / "compile_commands.json").read_text()))

    def test_the_environment_is_the_default(self):
        self.assertEqual(self.flags("a"), {"x86-64-v2"})
        self.assertEqual(self.flags("a", level="x86-64-v3"), {"x86-64-v2"})  # a folder keeps what it has
        self.assertEqual(self.flags("b", "-DFSI_ARCH=x86-64-v3"), {"x86-64-v3"})
        self.assertEqual(self.flags("c", level=""), {"native"})


class Containerfile(ScratchTest):
    def refused(self, text):
        """What is said of a file; the program ends with 1, after one line with the file's name."""
        file = self.scratch / "Containerfile"
        file.write_text(text)
        done = output(sys.executable, "-B", PARTS / "containerfile.py", file)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1))
        self.assertTrue(done.stderr.startswith(f"{file}:"))
        return done.stderr.removeprefix(f"{file}:")

    def test_instructions(self):
        text = """# a comment
FROM debian:12 AS build
ARG LEVEL=low
ENV A=1 B="two words"
RUN one && \\
    # within
    two
FROM debian:12
COPY --from=build /made /
WORKDIR /there
ENTRYPOINT ["run", "it"]
"""
        expected = [
            ["root", "build"],
            ["environment", "LEVEL=low"],
            ["environment", "A=1", "B=two words"],
            ["run", "one && two"],
            ["root", "1"],
            ["copy", "build", "/made", "/"],
            ["folder", "/there"],
            ["entry", "run", "it"],
        ]
        self.assertEqual(containerfile.read(text), expected)
        expected[1] = ["environment", "LEVEL=high"]
        self.assertEqual(containerfile.read(text, ["LEVEL=high"]), expected)

    def test_what_is_not_known_is_refused_with_its_line(self):
        begin, end = "FROM debian:12\n", 'ENTRYPOINT ["run"]\n'
        for line, why in (
            ("VOLUME /work", "'VOLUME' is not known here"),
            ("run make", "'run' is not known here"),
            ("FROM alpine", "only 'debian:12'"),
            ("FROM debian:12 build", "only 'debian:12'"),
            ("COPY --from=later /a /b", "with a stage above"),
            ("COPY --chown=user a /b", "the only option is --from"),
            ("COPY a b", "the last one from the root"),
            ("COPY a b /c", "whose path ends in /"),
            ("COPY *.deb /c/", "without wildcards"),
            ("WORKDIR here", "a path from the root"),
            ("ENV NAME", "'NAME=value'"),
            ("ENV A=$B", "known in RUN alone"),
            ("ARG NAME", "'NAME=default'"),
            ('RUN ["make"]', "a shell's command"),
            ("RUN --mount=type=cache make", "a shell's command"),
            ("ENTRYPOINT run", '["PROGRAM"'),
        ):
            with self.subTest(line):
                said = self.refused(begin + line + "\n" + end)
                self.assertTrue(said.startswith("2: "), said)
                self.assertIn(why, said)
        self.assertIn("1: RUN before the first FROM", self.refused("RUN make\n" + begin + end))
        self.assertIn("the last stage has no ENTRYPOINT", self.refused(begin))
        self.assertIn("the file ends within", self.refused(begin + "RUN make \\\n"))

    def test_ours_is_read_and_copies_what_there_is(self):
        instructions = containerfile.read(CONTAINERFILE.read_text(), ["FSI_ARCH=x86-64-v3"])
        self.assertIn(["environment", "FSI_ARCH=x86-64-v3"], instructions)
        self.assertEqual([words[1] for words in instructions if words[0] == "root"], ["build", "1"])
        for words in instructions:
            if words[:2] == ["copy", "."]:
                for source in words[2:-1]:
                    self.assertTrue((TOP / source).exists(), source)
        self.assertEqual(instructions[-1], ["entry", "/usr/local/bin/fsi-duo"])

    def test_copying(self):
        """COPY takes a file to a path, files into a folder, and of a folder what is in it."""
        (self.scratch / "from" / "inner").mkdir(parents=True)
        for name in ("a", "b", "inner/c"):
            (self.scratch / "from" / name).write_text(name)
        for words in ("from/a to/x/renamed", "from/a from/b to/both/", "from to/folder"):
            done = output("bash", "-euc", f". {PARTS}/container.sh; copy_into {words}", cwd=self.scratch)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        target = self.scratch / "to"
        found = sorted(str(file.relative_to(target)) for file in target.rglob("*") if file.is_file())
        expected = ["both/a", "both/b", "folder/a", "folder/b", "folder/inner/c", "x/renamed"]
        self.assertEqual(found, expected)
        self.assertEqual((target / "x" / "renamed").read_text(), "a")


class Entry(ScratchTest):
    """containers/entry.sh, with stand-ins for the programs."""

    def start(self, *words, home=None):
        for name in ("fsi-mesh", "fsi-monolithic", "fsi-partitioned", "fsi-compare"):
            program = self.scratch / name
            program.write_text('#!/bin/sh\n[ -w "$HOME" ] || exit 9\necho "$(basename "$0") $*"\n')
            program.chmod(stat.S_IRWXU)
        environment = {"PATH": f"{self.scratch}:/usr/bin:/bin", "TMPDIR": str(self.scratch)}
        if home is not None:
            environment["HOME"] = str(home)
        done = output("sh", TOP / "containers" / "entry.sh", *words, env=environment)
        return done.returncode, done.stdout, done.stderr

    def test_programs_and_versions(self):
        expected = (0, "fsi-mesh artery -o a b.msh\n", "")
        self.assertEqual(self.start("fsi-mesh", "artery", "-o", "a b.msh", home=self.scratch), expected)
        self.assertEqual(self.start("fsi-mesh", "artery", "-o", "a b.msh", home="/no/home"), expected)
        code, said, _ = self.start("--version")
        self.assertEqual((code, len(said.splitlines())), (0, 4))
        self.assertIn("usage: fsi-mesh", self.start("--help")[1])

    def test_anything_else_is_refused(self):
        code, said, errors = self.start("rm")
        self.assertEqual((code, said), (1, ""))
        self.assertIn("'rm' is no program of this container", errors)


if __name__ == "__main__":
    unittest.main()
