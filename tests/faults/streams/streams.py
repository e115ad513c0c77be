"""Standard streams that are closed, full or read by nobody: results and exit codes do not depend on them.

Every state of the three streams is tried with runs that end well, that are refused, that do not converge, with meshes,
and with texts that were asked for (help, version). What is judged: the exit code, the bytes of the results, and what is
said where something can be said.
"""

import itertools
import os
import shutil
import signal
import subprocess

from harness import DRIVERS, NEO_HOOKEAN, Harness, is_one_message, summary, tiny_mesh
from results import differences

STEPS = 4
STATES = ("file", "closed", "full", "unread")  # of an output; "unread": a pipe without a reader
NOT_PRINTED = "standard output"


def run(command, output="file", errors="file", no_input=False, base=None):
    """Runs with outputs in these states; returns exit code and the texts, "" where they cannot be had."""
    ends, opened = {}, []
    for name, state in (("out", output), ("err", errors)):
        if state == "file":
            ends[name] = open(base / name, "w+b")
        elif state == "full":
            ends[name] = open("/dev/full", "wb")
        elif state == "unread":
            reader, writer = os.pipe()
            os.close(reader)
            ends[name] = os.fdopen(writer, "wb")
        else:
            ends[name] = open(os.devnull, "wb")  # closed by the shell below
        opened.append(ends[name])
    redirections = " ".join(
        text
        for text, wanted in (("<&-", no_input), (">&-", output == "closed"), ("2>&-", errors == "closed"))
        if wanted
    )
    process = subprocess.run(
        ["sh", "-c", f'exec "$@" {redirections}', "sh", *map(str, command)],
        stdin=subprocess.DEVNULL,
        stdout=ends["out"],
        stderr=ends["err"],
        timeout=120,
        preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_DFL),  # as a shell starts programs
    )
    for file in opened:
        file.close()
    text = {
        name: (base / name).read_text() if state == "file" else "" for name, state in (("out", output), ("err", errors))
    }
    return process.returncode, text["out"], text["err"]


class Streams:
    def __init__(self, harness):
        self.harness, self.base = harness, harness.base
        self.mesh = tiny_mesh(harness)

    def command(self, program, folder, *settings, steps=STEPS):
        words = [self.harness.program(program), NEO_HOOKEAN, "-o", folder, "--threads", 1, "--force"]
        for setting in (f"mesh.file={self.mesh}", f"time.end={0.125 * steps}", "partitioned.tolerance=1e-2", *settings):
            words += ["--set", setting]
        return words

    def states(self):
        """(output, errors, no_input): all of them, or those in which one stream at a time is not a file, and closed ones
        together."""
        every = list(itertools.product(STATES, STATES, (False, True)))
        if self.harness.full:
            return every
        return [s for s in every if sum((s[0] != "file", s[1] != "file", s[2])) == 1 or set(s) == {"closed", True}]

    def judge(self, what, state, good, wrong, ended):
        """One run; `good` says whether it is as promised."""
        code, output, errors = ended
        self.harness.count("as promised" if good else wrong, f"{what}, {state}: exit {code}, {output!r}, {errors!r}")

    def runs_that_end_well(self, program):
        reference = self.base / f"reference-{program}"
        run(self.command(program, reference), base=self.base)
        for state in self.states():
            folder = self.base / "run"
            code, output, errors = run(self.command(program, folder), *state, base=self.base)
            good = code == 0 and summary(folder).get("status") == "done" and not differences(folder, reference)
            if state[0] == "file":
                good &= output.count("\n") == STEPS + 1
            if state[1] == "file":
                one = errors.count("\n") == 1 and f"{program}: warning: the {NOT_PRINTED} cannot be written" in errors
                good &= one if state[0] == "full" else errors == ""
            good &= (state[0] == "file") != ("without showing progress" in (folder / "run.log").read_text())
            self.judge(f"run of {program}", state, good, "harmed", (code, output, errors))

    def runs_that_fail(self, program):
        for settings, wanted in (
            (("fluid.density=-1",), 1),
            (("newton.max_iterations=1", "partitioned.max_iterations=1"), 2),
        ):
            for state in self.states():
                shutil.rmtree(self.base / "failed", ignore_errors=True)
                code, output, errors = run(
                    self.command(program, self.base / "failed", *settings), *state, base=self.base
                )
                good = code == wanted
                if state[1] == "file":
                    last = errors.splitlines(keepends=True)[-1:]
                    good &= bool(last) and is_one_message(last[0], program)
                self.judge(f"{program} ends with {wanted}", state, good, "wrong exit", (code, output, errors))

    def texts(self, program, *options):
        for state in self.states():
            code, output, errors = run((self.harness.program(program), *options), *state, base=self.base)
            good = code == (0 if state[0] == "file" else 1)
            if state[0] == "file":
                good &= len(output) > 5
            elif state[1] == "file":
                good &= is_one_message(errors, program) and NOT_PRINTED in errors
            self.judge(f"{program} {' '.join(options)}", state, good, "text lost", (code, output, errors))

    def meshes(self):
        reference = self.mesh.read_bytes()
        for state in self.states():
            file = self.base / "made.msh"
            file.unlink(missing_ok=True)
            command = (self.harness.program("fsi-mesh"), "artery", "--size", 2, "--axial-size", 1, "--length", 2)
            code, output, errors = run((*command, "-o", file), *state, base=self.base)
            good = file.read_bytes() == reference and not list(self.base.glob(".*.msh"))
            good &= code == (1 if state[0] == "full" else 0)
            if state[1] == "file" and state[0] == "full":
                good &= is_one_message(errors, "fsi-mesh") and NOT_PRINTED in errors and str(file.name) in errors
            self.judge("mesh", state, good, "harmed", (code, output, errors))

    def reader_that_leaves(self, program):
        """`fsi-monolithic ... | head -1`: the run goes on to its end."""
        reference = self.base / f"reference-{program}"
        folder = self.base / "headed"
        for lines in range(STEPS + 1 if self.harness.full else 2):
            with subprocess.Popen(
                [str(word) for word in self.command(program, folder)],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_DFL),
            ) as process:
                for _ in range(lines):
                    process.stdout.readline()
                process.stdout.close()
                errors = process.stderr.read().decode()
                code = process.wait(timeout=120)
            good = code == 0 and errors == "" and not differences(folder, reference)
            self.judge(f"{program} | head -{lines}", "unread later", good, "harmed", (code, "", errors))


def main():
    harness = Harness("streams", __doc__, good=("as promised",))
    streams = Streams(harness)
    for program in DRIVERS if harness.full else DRIVERS[:1]:
        streams.runs_that_end_well(program)
        streams.runs_that_fail(program)
        streams.reader_that_leaves(program)
    streams.meshes()
    for program in (*DRIVERS, "fsi-mesh"):
        options = ("--help", "--version") + (("--help-keys",) if program in DRIVERS else ())
        for option in options if harness.full else options[:1]:
            streams.texts(program, option)
    harness.finish()


if __name__ == "__main__":
    main()
