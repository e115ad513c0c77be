"""Units of a case whose program has none of its own: whatever three units it was written in, to mm, mg and ms."""

from dataclasses import dataclass

from ..base.errors import InputError
from ..base.suggestions import hint


@dataclass(frozen=True)
class Units:
    """One unit of length, mass and time in mm, mg and ms; all others follow: kPa = mg/(mm ms^2)."""

    name: str
    length: float
    mass: float
    time: float

    def of(self, length: int = 0, mass: int = 0, time: int = 0) -> float:
        """Factor of a quantity with these exponents."""
        return rounded(self.length**length * self.mass**mass * self.time**time)

    density = property(lambda self: self.of(-3, 1))
    pressure = property(lambda self: self.of(-1, 1, -2))
    viscosity = property(lambda self: self.of(-1, 1, -1))
    flow = property(lambda self: self.of(3, 0, -1))
    resistance = property(lambda self: self.of(-4, 1, -1))
    compliance = property(lambda self: self.of(4, -1, 2))
    spring = property(lambda self: self.of(-2, 1, -2))  # pressure over length
    damper = property(lambda self: self.of(-2, 1, -1))  # pressure over velocity


CGS = Units("cgs", 10.0, 1000.0, 1000.0)
SYSTEMS: dict[str, Units] = {
    "cgs": CGS,  # cm, g, s: what svMultiPhysics and SimVascular are used with
    "si": Units("si", 1000.0, 1e6, 1000.0),  # m, kg, s
    "mm-g-s": Units("mm-g-s", 1.0, 1000.0, 1000.0),
}


def units_of(name: str) -> Units:
    """Units by name. Raises InputError."""
    if name not in SYSTEMS:
        raise InputError("", "--units", f"'{name}' is no system of units", hint(name, SYSTEMS, "There are"))
    return SYSTEMS[name]


def rounded(value: float) -> float:
    """The value to 14 digits: a factor that is a power of ten stays one, whatever its product leaves."""
    return float(f"{value:.14g}")
