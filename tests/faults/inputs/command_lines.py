"""Command lines that are wrong: options doubled, empty, unknown, with wrong values, in any order."""

import random

from trial import Trial

WORDS = ("", " ", "-", "--", "---", "-1", "0", "1", "2", "1e300", "nan", "2147483648", "9223372036854775808", "a", "out",
         "case.toml", "x" * 5000, "\x1b[31m", "a\nb", "=", "time.end=", "/dev/null/out", ".", "..", "/", "%s%n", "@")  # fmt: skip
LINEAR_STUDY = "fsi-linear-study"
OPTIONS = ("-o", "--output", "--set", "--threads", "-q", "--quiet", "--outptu", "-x")
DRIVER_OPTIONS = ("--restart", "--force")
STUDY_OPTIONS = ("--systems", "--solvers", "--tolerance", "--sub-problems")
MESH_OPTIONS = ("-o", "--output", "--inner-radius", "--media", "--adventitia", "--length", "--level", "--size",
                "--axial-size", "--lumen-cells", "--media-cells", "--adventitia-cells", "--around", "--axial-cells",
                "--lumen-grading", "--axial-grading", "--order", "--sector", "--for", "--error", "--format", "--threads",
                "--axisymmetric", "--mirrored", "--binary", "--quiet", "--lenght")  # fmt: skip
MESH_VALUES = ("", "0", "-1", "1", "7", "1e-9", "1e-300", "1e300", "nan", "inf", "2147483647", "2147483648",
               "9223372036854775808", "a", "1.5", "%", "1%", "p2p1", "\x1b")  # fmt: skip


def drivers_lines(case, mesh, drivers, seed):
    """Trials without end: an ordinary command line with words put in, doubled, taken out."""
    chance = random.Random(seed)
    while True:
        driver = chance.choice((*drivers, LINEAR_STUDY))
        words = ["case.toml", "-o", "out", "-q", "--threads", "1"]
        options = OPTIONS + (STUDY_OPTIONS if driver == LINEAR_STUDY else DRIVER_OPTIONS)
        for _ in range(chance.randrange(1, 4)):
            kind = chance.randrange(4)
            at = chance.randrange(len(words) + 1)
            if kind == 0:
                words[at:at] = [chance.choice(options)]
            elif kind == 1:
                words[at:at] = [chance.choice(options), chance.choice(WORDS)]
            elif kind == 2 and at < len(words):
                words[at] = chance.choice(WORDS)
            elif at < len(words) - 1:
                del words[at]
        yield Trial(f"{driver} {' '.join(words)!r:.200}", driver, words, {"case.toml": case, "tiny.msh": mesh})


def mesh_lines(seed):
    """Each option of fsi-mesh with each value, then combinations without end."""
    small = ["artery", "-q", "--size", "2", "--axial-size", "2", "--length", "4"]
    for option in MESH_OPTIONS:
        for value in MESH_VALUES:
            yield mesh_trial([*small, "-o", "x.msh", option, value])
        yield mesh_trial([*small, "-o", "x.msh", option])
        if option.startswith("--"):
            kept = [word for at, word in enumerate(small) if word != option and (at == 0 or small[at - 1] != option)]
            for value in MESH_VALUES:
                yield mesh_trial([*kept, "-o", "x.msh", option, value])
    chance = random.Random(seed)
    while True:
        words = [*small[:2], *(("-o", "x.msh") if chance.random() < 0.9 else ())]
        for _ in range(chance.randrange(1, 5)):
            words += [chance.choice(MESH_OPTIONS)] + ([chance.choice(MESH_VALUES)] if chance.random() < 0.8 else [])
        yield mesh_trial(words)


def mesh_trial(words):
    return Trial(f"fsi-mesh {' '.join(words)!r:.200}", "fsi-mesh", words)
