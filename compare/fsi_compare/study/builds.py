"""How many of the finished runs that a study takes up were made by another build of their program: they are
recognised by its version, which a program built anew may keep."""


from ..starting.programs import Program


class Builds:
    """`runs`: what is counted; `remedy`: what makes all of them again."""

    def __init__(self, runs: str, remedy: str):
        self._runs, self._remedy = runs, remedy
        self._taken_up = 0
        self._others: list[str] = []  # name and version of the program, for each run of another build

    def count(self, program: Program, digest: str) -> None:
        """`digest`: of the executable that made the run; empty: not recorded, so that it may be any."""
        self._taken_up += 1
        if digest != program.digest:
            self._others.append(f"{program.path.name} {program.version}")

    @property
    def warning(self) -> str:
        """A sentence without its full stop; empty: the present build made all."""
        if not self._others:
            return ""
        count, programs = len(self._others), " and ".join(sorted(set(self._others)))
        return (
            f"{count} of {self._taken_up} {self._runs} {'was' if count == 1 else 'were'} made by another build of "
            f"{programs}: {self._remedy} makes {'it' if count == 1 else 'them'} again"
        )
