"""What ends the iterations of a driver, by the case: the entries that a member with looser tolerances changes.

| driver and scheme | stops by |
|---|---|
| monolithic | `newton.error_tolerance` where demanded, else `newton.tolerance` where named; where neither is, the former in runs of fixed steps, else the latter; `residual_tolerance` besides, where demanded |
| partitioned, `robin-neumann-inexact` (its default) | `partitioned.tolerance` where the case names it, else as the monolithic driver; `force_tolerance` besides, where demanded |
| partitioned, `block-newton` | `partitioned.tolerance` where the case names it, else as the monolithic driver |
| partitioned, any other scheme | `partitioned.tolerance`; `force_tolerance` besides, where demanded |

Where the case names no scheme, the driver chooses one by the scene (partitioned/scheme_choice.cpp), which a case file
alone does not tell: a run's `summary.json` does (runs/coupling.py)."""

from typing import Any, Mapping

ERROR_TOLERANCE = 3e-3  # unless a case names one: as common/case/case.hpp has it
WALL_ERROR_TOLERANCE = 3e-4  # likewise, without fluid
NEWTON_TOLERANCE = 1e-3  # the same
GAP_TOLERANCE = 1e-6  # the same
DEFAULT_SCHEME = "robin-neumann-inexact"  # around vessels
BY_ERROR = (DEFAULT_SCHEME, "block-newton")  # schemes that end by the error of a step, others by the interface's gap


def names_scheme(entries: Mapping[str, Any]) -> bool:
    """Whether the case itself says by which scheme `fsi-partitioned` couples."""
    return "scheme" in _section(entries, "partitioned")


def governing(program: str, entries: Mapping[str, Any], chosen: str | None = None) -> dict[str, float]:
    """Tolerances of `fsi-monolithic` or `fsi-partitioned` by their full keys. `entries`: of a case that the driver has
    run, for numbers are not checked here. `chosen`: the scheme that the driver took where the case names none; None: no
    run has told yet, and the one around vessels is assumed."""
    newton, coupling = _section(entries, "newton"), _section(entries, "partitioned")
    if program == "fsi-partitioned":
        scheme = coupling.get("scheme", chosen or DEFAULT_SCHEME)
        if scheme not in BY_ERROR:
            gap = {"partitioned.tolerance": float(coupling.get("tolerance", GAP_TOLERANCE))}
            return {**gap, **_demanded("partitioned", coupling, "force_tolerance")}
        if "tolerance" in coupling:
            error = {"partitioned.tolerance": float(coupling["tolerance"])}
            return {**error, **_beside(program, scheme, coupling, newton)}
    else:
        scheme = ""
    found = _demanded("newton", newton, "error_tolerance")
    has_fixed_steps = "time" in entries and _section(entries, "time").get("step") != "adaptive"
    if not found and not {"error_tolerance", "tolerance"} & set(newton) and has_fixed_steps:
        found = {"newton.error_tolerance": ERROR_TOLERANCE if "fluid" in entries else WALL_ERROR_TOLERANCE}
    if not found:
        found = {"newton.tolerance": float(newton.get("tolerance", NEWTON_TOLERANCE))}
    return {**found, **_beside(program, scheme, coupling, newton)}


def _beside(program: str, scheme: str, coupling: Mapping[str, Any], newton: Mapping[str, Any]) -> dict[str, float]:
    """Tolerances demanded besides: an interface iteration has no residual of both media."""
    if program == "fsi-partitioned" and scheme == DEFAULT_SCHEME:
        return _demanded("partitioned", coupling, "force_tolerance")
    return _demanded("newton", newton, "residual_tolerance")


def _section(entries: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    section = entries.get(name, {})
    return section if isinstance(section, Mapping) else {}


def _demanded(name: str, section: Mapping[str, Any], key: str) -> dict[str, float]:
    """The tolerance by its full key; empty where it is 0, which demands nothing."""
    value = float(section.get(key, 0.0))
    return {f"{name}.{key}": value} if value > 0 else {}
