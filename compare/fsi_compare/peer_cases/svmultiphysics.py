"""Cases of svMultiPhysics (solver.xml and the folder of its mesh): FSI, fluid between rigid walls, and walls alone.

What its words mean is taken from its sources: Parameters.cpp (defaults), read_files.cpp (read_bc, read_domain),
set_bc.cpp (a value of Dir is along the normal out of the fluid, one of Neu a pressure against it), fluid.cpp
(backflow)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError, printable
from ..base.files import absolute
from ..base.numbers import parsed
from ..base.suggestions import hint
from .geometry import CaseMesh, Face, plain_names, read_case_mesh
from .model import Note, PeerCase
from .svmultiphysics_laws import Layer, layer_of, viscosity_of
from .units import Units
from .waveforms import Waveform, read_coefficients, read_series
from .xml_file import Entry

PROGRAM = "svMultiPhysics"
EQUATIONS = {"FSI": "FSI", "fluid-solid-interaction": "FSI", "fluid": "fluid", "struct": "struct"}
EQUATIONS |= {"structural": "struct", "ustruct": "ustruct", "structural_velocity_pressure": "ustruct"}
EQUATIONS |= {"lElas": "lElas", "linear_elasticity": "lElas"}
WALLS = ("struct", "ustruct", "lElas")
CMM = ("CMM", "coupled_momentum")
TRANSPORTS = ("AD", "advection_diffusion", "heatF", "dyeTransport", "scalarTransport")
REFUSED = {
    "stokes": "a flow without inertia",
    "shell": "a shell",
    **{name: "the electrophysiology of the heart" for name in ("CEP", "cardiac_electro_physiology")},
    **{name: "heat in a solid" for name in ("heatS", "solid_heat", "laplace", "poisson")},
}
# What stands in a case and is ours to decide: what is done in its place, by the entry's name.
INSTEAD = {
    "LS": "linear solvers are chosen by the drivers, see [linear]",
    "Coupled": "fluid, wall and mesh are always coupled within a step",
    **dict.fromkeys(("Min_iterations", "Max_iterations"), "iterations end by the drivers' tolerances"),
    "Tolerance": "the drivers' own, newton.error_tolerance",
    "Output": "fields are named by output.fields",
    "Zero_out_perimeter": "the rim of an opening sticks to the wall",
    "Impose_on_state_variable_integral": "supports fix displacements",
    "Use_taylor_hood_type_basis": "element, see below",
    "Momentum_stabilization_coefficient": "structure.stabilisation has a value of its own",
    "Continuity_stabilization_coefficient": "structure.stabilisation has a value of its own",
    "Explicit_geometric_coupling": "the mesh moves with the step's own displacement",
    "Quadrature_modifier_TET4": "integration is exact for the element",
    "Linear_algebra": "linear solvers are chosen by the drivers",
    **dict.fromkeys(
        ("Save_results_to_VTK_format", "Name_prefix_of_saved_VTK_files", "Save_results_in_folder")
        + ("Start_saving_after_time_step", "Save_averaged_results", "Start_averaging_from_zero")
        + ("Convert_BIN_to_VTK_format",),
        "results are in the folder given with -o, their times by output.every",
    ),
    **dict.fromkeys(
        ("Increment_in_saving_restart_files", "Overwrite_restart_file", "Restart_file_name"),
        "checkpoints are written by time, output.checkpoint_every",
    ),
    "Searched_file_name_to_trigger_stop": "a signal stops a run, which --restart continues",
    **{name: "the drivers' own messages" for name in ("Verbose", "Warning", "Debug")},
    "Check_IEN_order": "cells are turned as they must be",
    "Fiber_direction": "no fibres here: the law has none, or see its line",
    "Fiber_direction_file_path": "no fibres here: the law has none, or see its line",
}
# What changes the answer, and has nothing in its place.
LOST = {
    "Continue_previous_simulation": "the run begins at rest",
    "Initial_velocities_file_path": "the run begins at rest",
    "Initial_pressures_file_path": "the run begins at rest; what the wall carries in the mesh's shape is [prestress]",
    "Initial_displacements_file_path": "the run begins in the shape of the mesh",
    "Mass_damping": "there is none; support.NAME.damper damps at a surface, layers.NAME.viscosity in the wall",
    "Number_of_initialization_time_steps": "the run begins at rest",
    "Simulation_initialization_file_path": "the run begins at rest",
    "Simulation_requires_remeshing": "the mesh follows the wall, mesh_motion.method",
    "Weakly_applied": "the velocity is given itself",
    "Initialize_RCR_from_flow": 'Windkessels begin with initial_pressure; time.start = "lumped" finds a periodic one',
}
ELEMENTS = {
    1: "Cells of first order. svMultiPhysics: linear velocity, pressure and displacement, its wall without a pressure "
    "of its own (too stiff where nearly incompressible). Here: element = p1, linear and stabilised, the wall with a pressure. "
    '--set element="p2p1" solves on straight quadratic cells of the same mesh, more accurate at more cost.',
    2: "Cells of second order: element = p2p1, quadratic velocity and displacement, linear pressure.",
}


@dataclass
class Medium:
    """A mesh of the case."""

    entry: Entry
    given: str
    domain: int
    kind: str = ""  # fluid or wall
    name: str = "fluid"  # group; of a wall its own


def read_case(root: Entry, units: Units, fibre_angle: float | None, tolerance: float) -> PeerCase:
    """Reads solver.xml. Raises InputError."""
    return _Reader(root, units, fibre_angle, tolerance).read()


class _Reader:
    def __init__(self, root: Entry, units: Units, fibre_angle: float | None, tolerance: float) -> None:
        self.root, self.units, self.fibre_angle, self.tolerance = root, units, fibre_angle, tolerance
        self.folder = root.file.parent
        self.case = PeerCase(PROGRAM, root.file)
        self.fluid: dict[str, Any] = {}
        self.structure: dict[str, Any] = {}
        self.openings: list[dict[str, Any]] = []
        self.supports: dict[str, dict[str, Any]] = {}
        self.closed: list[str] = []
        self.symmetric: dict[str, str] = {}  # groups of planes of symmetry, by the face's name
        self.backflow = 0.2

    def read(self) -> PeerCase:
        for entry in [self.root, *self.root.every()]:
            if entry.name in ("Include_xml", "Include_parameters_file"):
                raise entry.refuse("names another file", "write its entries in its place")
        time = self._time(self.root.need("GeneralSimulationParameters"))
        equation = self._equation()
        kind = EQUATIONS[equation.attribute("type")]
        domains = self._domains(equation, kind)
        media = self._media(domains, kind)
        mesh = self._mesh(media)
        layers = self._domain_values(media, domains)
        self._conditions(equation)
        if self.closed:
            self.fluid["closed"] = self.closed
        self._assemble(mesh, time, layers, kind)
        self._name_the_rest()
        return self.case

    def _note(self, entry: Entry, words: str, matters: bool = False, what: str = "") -> None:
        """`what`: the entry's name in the note, its key unless it is given."""
        self.case.notes.append(Note(what or entry.key, f"line {entry.line}", words, matters))

    def _time(self, general: Entry) -> dict[str, Any]:
        if general.number("Number_of_spatial_dimensions", 3) != 3:
            raise general.need("Number_of_spatial_dimensions").refuse("is not 3", "give a case in three dimensions")
        step, count = general.need("Time_step_size"), general.need("Number_of_time_steps")
        dt, steps = step.as_number() * self.units.time, count.as_number()
        if dt <= 0:
            raise step.refuse(f"{step.text} is no length of a step", "give one above 0")
        if steps < 1 or steps != int(steps):
            raise count.refuse(f"{count.text} is no number of steps", "give 1 or more")
        radius = general.find("Spectral_radius_of_infinite_time_step")
        value = radius.as_number() if radius else 0.5
        if radius and not 0 <= value <= 1:
            raise radius.refuse(f"{value:g} is no spectral radius", "give one from 0 to 1")
        made: dict[str, Any] = {"step": dt, "end": dt * steps, "scheme": "generalised-alpha", "spectral_radius": value}
        self.every = int(general.number("Increment_in_saving_VTK_files", 0))
        return made

    def _equation(self) -> Entry:
        found: list[Entry] = []
        for entry in self.root.all("Add_equation"):
            given = entry.attribute("type")
            if given in CMM:
                self._refuse_membrane(entry)
            if given in REFUSED:
                raise entry.refuse(f"{given} is {REFUSED[given]}, which ours does not solve", "take that equation out")
            if given == "mesh":
                self._mesh_motion(entry)
            elif given in TRANSPORTS:
                entry.take_all()
                self._note(entry, "left out: the transport of a substance", True, f"Add_equation {given}")
            elif given not in EQUATIONS:
                raise entry.refuse(f"'{given}' is no equation", hint(given, EQUATIONS, "There are") + " and mesh")
            else:
                found.append(entry)
        if len(found) != 1:
            problem = f"has {len(found)} equations of fluid or wall"
            raise self.root.refuse(problem, "give one: FSI, fluid, struct, ustruct or lElas")
        equation = found[0]
        if equation.yes("Prestress", False):
            own = "[prestress] pressure = ... (kPa), which finds the wall's load itself"
            remedy = f"take it out, and give the case {own}"
            raise equation.need("Prestress").refuse("computes a prestress, which ours finds in another way", remedy)
        if equation.all("Add_BF"):
            remedy = "take it out; of a wall's weight see structure.gravity"
            raise equation.all("Add_BF")[0].refuse("is a force on volumes, which ours has not", remedy)
        return equation

    def _refuse_membrane(self, entry: Entry) -> None:
        thickness = entry.number("Shell_thickness", 0.0) * self.units.length
        young = entry.number("Elasticity_modulus", 0.0) * self.units.pressure
        nu = entry.number("Poisson_ratio", 0.5)
        wall = f"coupled momentum; {thickness:g} mm, {young:g} kPa, Poisson's ratio {nu:g}"
        words = f"has a wall without thickness ({wall})"
        remedy = f"import the fluid by fsi-mesh import, give it a wall by fsi-mesh thicken, and that young = {young:g}"
        raise entry.refuse(words, remedy)

    def _mesh_motion(self, entry: Entry) -> None:
        ratio = entry.find("Poisson_ratio")
        entry.take_all()
        words = "mesh_motion.method = stiffened: small cells deform least, as in its elastic mesh; openings move with "
        words += "the ends of the wall that meet them, and not where these are clamped"
        words += f" (Poisson_ratio {ratio.text})" if ratio else ""
        self._note(entry, words, what="Add_equation mesh")

    def _domains(self, equation: Entry, kind: str) -> dict[int, tuple[Entry, str]]:
        """By number: the entry with the domain's values, and its equation."""
        given = equation.all("Domain")
        if not given:
            if kind == "FSI":
                raise equation.refuse("has no Domain", "give one of the fluid and one of the wall")
            return {0: (equation, kind)}
        domains: dict[int, tuple[Entry, str]] = {}
        for entry in given:
            name = entry.attribute("id")
            if not name.lstrip("-").isdigit():
                raise entry.refuse(f"id '{name}' is no whole number", "give the number in Domain of an Add_mesh")
            if int(name) in domains:
                raise entry.refuse("is there twice", "give each a number of its own")
            own = entry.word("Equation", kind)
            allowed = ("fluid", *WALLS) if kind == "FSI" else (kind,)
            if EQUATIONS.get(own) not in allowed:
                raise entry.refuse(f"has the equation '{own}'", f"there are {', '.join(allowed)}")
            domains[int(name)] = (entry, EQUATIONS[own])
        return domains

    def _media(self, domains: dict[int, tuple[Entry, str]], kind: str) -> list[Medium]:
        media: list[Medium] = []
        for entry in self.root.all("Add_mesh"):
            given = entry.attribute("name")
            for word in ("Set_mesh_as_shell", "Set_mesh_as_fibers"):
                if entry.yes(word, False):
                    raise entry.need(word).refuse("is no mesh of volumes", "give tetrahedra")
            if (several := entry.find("Domain_file_path")) is not None:
                raise several.refuse("divides a mesh in domains", "give a mesh for each domain, with its own Domain")
            if (prestress := entry.find("Prestress_file_path")) is not None:
                raise prestress.refuse("gives a prestress, which ours finds itself", "take it out; see [prestress]")
            number = entry.number("Domain", 0)
            if number not in domains:
                known = ", ".join(str(n) for n in domains)
                if len(domains) == 1 and not entry.all("Domain"):
                    number = next(iter(domains))
                else:
                    raise entry.refuse(f"is of the domain {number:g}, which no equation has", f"there are {known}")
            if any(medium.given == given for medium in media):
                raise entry.refuse("is there twice", "give each mesh a name of its own")
            media.append(Medium(entry, given, int(number), "fluid" if domains[int(number)][1] == "fluid" else "wall"))
        if not media:
            raise self.root.refuse("has no Add_mesh", "give one")
        fluids = [medium for medium in media if medium.kind == "fluid"]
        if len(fluids) > 1:
            raise fluids[1].entry.refuse("is a second mesh of the fluid", "make one mesh of both")
        if kind == "FSI" and not (fluids and len(media) > 1):
            problem = "has FSI without a mesh of the fluid and one of a wall"
            raise self.root.refuse(problem, "give both, each with its Domain")
        walls = [medium for medium in media if medium.kind == "wall"]
        for medium, name in zip(walls, plain_names([wall.given for wall in walls], ["fluid"])):
            medium.name = name
        return media

    def _mesh(self, media: list[Medium]) -> CaseMesh:
        scales = {medium.entry.number("Mesh_scale_factor", 1.0) for medium in media}
        if len(scales) > 1:
            raise media[-1].entry.refuse("has a Mesh_scale_factor of its own", "give all meshes one unit of length")
        (scale,) = scales
        if scale <= 0:
            media[0].entry.positive("Mesh_scale_factor")
        faces: list[tuple[Entry, Medium, str]] = []
        for medium in media:
            for entry in medium.entry.all("Add_face"):
                given = entry.attribute("name")
                if any(given == known for _, _, known in faces):
                    raise entry.refuse("is there twice", "give each face a name of its own")
                faces.append((entry, medium, given))
        names = plain_names([given for _, _, given in faces], [medium.name for medium in media])
        files = {medium.name: self._file(medium.entry.need("Mesh_file_path")) for medium in media}
        rows = []
        for (entry, medium, given), name in zip(faces, names):
            path = self._file(entry.need("Face_file_path"))
            if path.suffix.lower() != ".vtp":
                raise entry.need("Face_file_path").refuse(f"{path.name} is no .vtp", "give the face as .vtp")
            rows.append((name, given, medium.name, path))
            if name != given:
                self._note(entry, f"called {name} here", what=f"Add_face {given}")
        for medium in media:
            if medium.name != medium.given and medium.kind == "wall":
                self._note(medium.entry, f"called {medium.name} here", what=f"Add_mesh {medium.given}")
        for entry in self.root.all("Add_projection"):
            entry.all("Project_from_face")
        to_mm = scale * self.units.length
        mesh, self.case.faces = read_case_mesh(str(self.root.file), files, rows, to_mm, self.tolerance)
        if "fluid" in files and len(files) > 1 and not any(face.on_interface for face in self.case.faces):
            at = next(iter(self.root.all("Add_projection")), self.root)
            raise at.refuse("fluid and wall share no face: their nodes differ", "mesh both together, or give --join MM")
        return mesh

    def _file(self, entry: Entry) -> Path:
        if not entry.text:
            raise entry.refuse("names no file", "give its path")
        path = self.folder / entry.text
        if not path.is_file():
            raise entry.refuse(f"there is no file {path}", "give its path, from the folder of the case")
        return path

    def _domain_values(self, media: list[Medium], domains: dict[int, tuple[Entry, str]]) -> dict[str, Layer]:
        layers: dict[str, Layer] = {}
        for medium in media:
            entry, own = domains[medium.domain]
            if medium.kind == "fluid":
                self._fluid(entry)
                continue
            layer = layer_of(entry, own, self.units, self.fibre_angle)
            layers[medium.name] = layer
            for note in layer.notes:
                self._note(*note)
            forces = [entry.number(f"Force_{axis}", 0.0) * self.units.of(1, 0, -2) for axis in "xyz"]
            if any(forces):
                self.structure["gravity"] = forces
        for name, layer in layers.items():
            first = next(iter(layers.values()))
            for what in ("density", "bulk modulus"):
                key = what.replace(" ", "_")
                if getattr(layer, key) != getattr(first, key):
                    problem = f"the wall {name} has another {what} than the first, ours has one for all"
                    raise InputError(self.root.file, name, problem, "give both the same")
        return layers

    def _fluid(self, entry: Entry) -> None:
        density = entry.number("Density", 0.5) * self.units.density
        if not entry.all("Density"):
            self._note(entry, "has no Density: 0.5, its program's default", True)
        if density <= 0:
            entry.positive("Density")
        if not 0.5 <= density <= 2:
            units = f"are the case's units {self.units.name}? see --units"
            words = f"a density of {density:g} mg/mm^3, water has 1: {units}"
            self._note(entry.need("Density"), words, True, "Density")
        viscosity, notes = viscosity_of(entry, self.units)
        self.fluid = {"density": density, **viscosity}
        for note in notes:
            self._note(*note)
        self.backflow = entry.number("Backflow_stabilization_coefficient", 0.2)
        for axis in "xyz":
            if entry.number(f"Force_{axis}", 0.0):
                raise entry.need(f"Force_{axis}").refuse("is a force on the fluid, which ours has not", "take it out")
        porous = entry.find("Inverse_darcy_permeability")
        if porous is not None and porous.as_number():
            raise porous.refuse("is a porous fluid, which ours has not", "take it out")

    def _conditions(self, equation: Entry) -> None:
        by_face: dict[str, list[Entry]] = {face.given: [] for face in self.case.faces}
        for entry in equation.all("Add_BC"):
            given = entry.attribute("name")
            if given not in by_face:
                raise entry.refuse(f"there is no face '{given}'", hint(given, by_face, "There are"))
            by_face[given].append(entry)
        for face in self.case.faces:
            entries = by_face[face.given]
            if face.on_interface:
                if entries:
                    raise entries[0].refuse("is on the interface of fluid and wall", "take the condition out")
                self.case.said.append(f"{face.given}: on the interface of fluid and wall")
            elif face.medium == "fluid":
                self._opening(face, entries)
            else:
                for entry in entries:
                    self._support(face, entry)
                if not entries:
                    self.case.said.append(f"{face.given}: a free face of the wall")

    def _opening(self, face: Face, entries: list[Entry]) -> None:
        if len(entries) > 1:
            raise entries[1].refuse("is a second condition of a face of the fluid", "give one")
        if not entries:
            if not face.flat:
                problem = "has no Add_BC, and is not flat: svMultiPhysics would let fluid through it"
                remedy = "give it one: of a wall Dir with Value 0"
                raise InputError(self.root.file, f"Add_face {face.given}", problem, remedy)
            self.openings.append({"surface": face.name, "backflow": 0.0})
            self.case.notes.append(Note(f"Add_face {face.given}", "no Add_BC", "an opening free of traction, as there"))
            return
        (entry,) = entries
        given = entry.word("Type")
        if given in ("Dir", "Dirichlet"):
            self._given_velocity(face, entry)
        elif given in ("Neu", "Neumann"):
            self._given_pressure(face, entry)
        else:
            raise entry.refuse(f"Type '{given}' of a face of the fluid has no counterpart", "there are Dir and Neu")

    def _given_velocity(self, face: Face, entry: Entry) -> None:
        dependence = entry.word("Time_dependence", "Steady")
        flux, profile = entry.yes("Impose_flux", False), entry.word("Profile", "Flat")
        fixed = self._fixed(entry)
        if dependence == "Steady":
            value = entry.number("Value", 0.0)
            if value == 0 and fixed == face.axis:
                self.symmetric[face.name] = f"symmetry_{fixed}"
                self.case.said.append(f"{face.given}: a plane of symmetry, called symmetry_{fixed} here")
                return
            if value == 0 and len(fixed) < 3:
                along = f"holds the velocity along {' and '.join(fixed)} only"
                problem = f"{along}, and the face is no plane of symmetry, which is normal to that one axis"
                remedy = "take it out where the face is a wall; turn the mesh where it is such a plane"
                raise entry.need("Effective_direction").refuse(problem, remedy)
            if value == 0:
                self.closed.append(face.name)
                self.case.said.append(f"{face.given}: a rigid wall, fluid.closed")
                return
        elif dependence != "Unsteady":
            raise self._time_dependence(entry, dependence, "Steady and Unsteady")
        if any(self._direction(entry)):
            raise entry.need("Effective_direction").refuse("is another direction than the normal", "take it out")
        known = {"Flat": "plug", "Parabolic": "parabolic"}
        if profile not in known:
            raise entry.refuse(f"the Profile {profile} has no counterpart", f"there are {', '.join(known)}")
        factor = -self.units.flow
        if not flux:
            # Of a velocity: the flow is its integral, of a parabola over a circle half of area and peak.
            share = 1.0 if profile == "Flat" else 0.5
            factor = -self.units.of(1, 0, -1) * face.area * share
            flow = f"a flow_rate of it times {share:g} times the area, {face.area:.6g} mm^2"
            self._note(entry, f"a velocity (no Impose_flux): {flow}", True)
        opening: dict[str, Any] = {"surface": face.name}
        if dependence == "Steady":
            opening["flow_rate"] = factor * value
        else:
            opening |= self._table(face, entry, "flow_rate", ("time_ms", "flow_mm3_per_ms"), factor)
        opening["profile"] = known[profile]
        self.openings.append(opening)
        self.case.said.append(f"{face.given}: flow_rate into the fluid, with the sign turned")

    def _given_pressure(self, face: Face, entry: Entry) -> None:
        dependence = entry.word("Time_dependence", "Steady")
        opening: dict[str, Any] = {"surface": face.name}
        pressure = self.units.pressure
        if dependence == "Steady":
            value = entry.number("Value", 0.0) * pressure
            if value:
                opening["pressure"] = value
        elif dependence == "Unsteady":
            opening |= self._table(face, entry, "pressure", ("time_ms", "pressure_kPa"), pressure)
        elif dependence == "Resistance":
            opening["resistance"] = entry.positive("Value") * self.units.resistance
        elif dependence in ("RCR", "Windkessel"):
            opening["windkessel"] = self._windkessel(entry.need("RCR_values"))
        else:
            there_are = "Steady, Unsteady, Resistance and RCR"
            words = f"{there_are}; lumped models of svZeroDSolver or genBC are [network] of ours"
            raise self._time_dependence(entry, dependence, words)
        given = ", ".join(key for key in opening if key != "surface")
        self.case.said.append(f"{face.given}: {given or 'free of traction'}")
        opening["backflow"] = self.backflow
        self.openings.append(opening)

    def _windkessel(self, values: Entry) -> dict[str, Any]:
        resistance, pressure = self.units.resistance, self.units.pressure
        return {
            "proximal": values.positive("Proximal_resistance") * resistance,
            "compliance": values.positive("Capacitance") * self.units.compliance,
            "distal": values.positive("Distal_resistance") * resistance,
            "initial_pressure": values.number("Initial_pressure", 0.0) * pressure,
            "distal_pressure": values.number("Distal_pressure", 0.0) * pressure,
        }

    @staticmethod
    def _time_dependence(entry: Entry, given: str, there_are: str) -> InputError:
        return entry.refuse(f"Time_dependence '{given}' has no counterpart", f"there are {there_are}")

    @staticmethod
    def _direction(entry: Entry) -> list[float]:
        found = entry.find("Effective_direction")
        if found is None:
            return []
        numbers = list(map(parsed, found.text.replace("(", " ").replace(")", " ").replace(",", " ").split()))
        if len(numbers) != 3 or not np.isfinite(numbers).all():
            raise found.refuse(f"'{found.text}' is no direction", "write, for one, (0, 0, 1)")
        return numbers

    def _fixed(self, entry: Entry) -> str:
        """Axes along which a Dirichlet condition holds; all without a direction."""
        return "".join(axis for axis, part in zip("xyz", self._direction(entry)) if part) or "xyz"

    def _wave(self, entry: Entry) -> tuple[Waveform, str]:
        series, coefficients = entry.find("Temporal_values_file_path"), entry.find("Fourier_coefficients_file_path")
        if series is not None:
            wave, error = read_series(self._file(series), entry.yes("Ramp_function", False))
            largest = float(np.abs(wave(np.linspace(0, wave.period, 257))).max())
            share = f"{100 * error / largest:.2g} % of its largest value" if largest else "0"
            series_words = f"its Fourier series of {len(wave.real)} modes, as there; off its points by {share}"
            return wave, "a ramp from its first value to its last" if wave.ramp else series_words
        if coefficients is not None:
            wave = read_coefficients(self._file(coefficients))
            return wave, f"its Fourier series of {len(wave.real)} modes"
        raise entry.refuse("is Unsteady without values", "give Temporal_values_file_path")

    def _table(self, face: Face, entry: Entry, key: str, header: tuple[str, str], factor: float) -> dict[str, Any]:
        """Keys of an opening or a support, whose rows are in a file beside the case."""
        wave, words = self._wave(entry)
        name = f"{face.name}.csv"
        rows = [(time * self.units.time, value * factor) for time, value in wave.rows()]
        self.case.tables[name] = header, rows
        made: dict[str, Any] = {key: {"file": name}}
        if not wave.ramp:
            made["period"] = wave.period * self.units.time
        self._note(entry, f"{name}: {words}, in {len(rows)} rows")
        return made

    def _support(self, face: Face, entry: Entry) -> None:
        support = self.supports.setdefault(face.name, {"surface": face.name})
        given, dependence = entry.word("Type"), entry.word("Time_dependence", "Steady")
        if (file := entry.find("Spatial_values_file_path")) is not None:
            raise file.refuse("varies over the face", "give one value")
        if given in ("Dir", "Dirichlet"):
            if dependence != "Steady" or entry.number("Value", 0.0):
                raise entry.refuse("moves a face of the wall", "give a load or a support: Value 0, Neu or Robin")
            support["fixed"] = [axis for axis in "xyz" if axis in {*support.get("fixed", []), *self._fixed(entry)}]
            self.case.said.append(f"{face.given}: fixed along {', '.join(support['fixed'])}")
        elif given in ("Neu", "Neumann", "Robin", "Rbn"):
            if given in ("Robin", "Rbn"):
                normal = "normal_" if entry.yes("Apply_along_normal_direction", False) else ""
                support[f"{normal}spring"] = entry.number("Stiffness", 1.0) * self.units.spring
                support[f"{normal}damper"] = entry.number("Damping", 1.0) * self.units.damper
                self.case.said.append(f"{face.given}: {normal}spring and {normal}damper")
            self._wall_load(face, entry, dependence, support)
        else:
            problem = f"Type '{given}' of a face of the wall has no counterpart"
            raise entry.refuse(problem, "there are Dir, Neu and Robin")
        if len(support) == 1:
            del self.supports[face.name]

    def _wall_load(self, face: Face, entry: Entry, dependence: str, support: dict[str, Any]) -> None:
        if entry.yes("Undeforming_neu_face", False):
            raise entry.need("Undeforming_neu_face").refuse("keeps a loaded face in its shape", "take it out")
        if dependence not in ("Steady", "Unsteady"):
            raise self._time_dependence(entry, dependence, "Steady and Unsteady")
        follows = entry.yes("Follower_pressure_load", False)
        pressure = self.units.pressure
        value = entry.number("Value", 0.0) if dependence == "Steady" else 1.0
        if value == 0:
            return
        if dependence == "Steady" and face.flat and not follows:
            support["traction"] = [-value * pressure * part for part in face.normal]
            self.case.said.append(f"{face.given}: a traction of the area at rest, against its normal")
            return
        if dependence == "Steady":
            support["pressure"] = value * pressure
        else:
            support |= self._table(face, entry, "pressure", ("time_ms", "pressure_kPa"), pressure)
        if not follows:
            words = "a pressure that follows the face; in svMultiPhysics it keeps the face's normal at rest"
            self._note(entry, words, True)
        self.case.said.append(f"{face.given}: a pressure on the wall")

    def _assemble(self, mesh: CaseMesh, time: dict[str, Any], layers: dict[str, Layer], kind: str) -> None:
        sections = self.case.sections
        folder = absolute(self.root.file).parent.name
        sections["title"] = printable(f"{folder or self.root.file.stem}, from {PROGRAM}")
        sections["element"] = "p1" if mesh.order == 1 else "p2p1"
        sections["mesh"] = {"file": "mesh.msh"}
        if layers:
            first = next(iter(layers.values()))
            self.structure = {"density": first.density, **self.structure}
            if first.bulk_modulus is not None:
                self.structure["bulk_modulus"] = first.bulk_modulus
            self.structure["layers"] = {name: layer.constants for name, layer in layers.items()}
        told: dict[str, Any] = {"fluid": self.fluid, "structure": self.structure, "opening": self.openings}
        told |= {"support": list(self.supports.values())}
        told |= {"mesh_motion": {"method": "stiffened"} if kind == "FSI" else {}, "time": time}
        told |= {"output": {"every": self.every} if self.every > 0 else {}}
        sections |= {name: entries for name, entries in told.items() if entries}
        for group in mesh.groups:
            group.name = self.symmetric.get(group.name, group.name)
        self.case.said += mesh.said + [ELEMENTS[mesh.order]]
        self.case.mesh = mesh

    def _name_the_rest(self) -> None:
        """A line for each kind of entry that no reader took."""
        found: dict[str, list[Entry]] = {}
        skipped: list[Entry] = []
        for entry in self.root.every():
            if entry.parent is not None and entry.parent in skipped:
                skipped.append(entry)
            elif not entry.taken or entry.name in LOST or entry.name in INSTEAD:
                skipped.append(entry)
                found.setdefault(entry.name, []).append(entry)
        for name, entries in found.items():
            if name in LOST and all(e.text.lower() in ("", "0", "false", "0.0") for e in entries):
                continue
            lines = ", ".join(str(entry.line) for entry in entries[:6]) + (", ..." if len(entries) > 6 else "")
            where = f"line{'s' if len(entries) > 1 else ''} {lines}"
            instead = LOST.get(name, INSTEAD.get(name, "no counterpart: passed over"))
            self.case.notes.append(Note(name, where, instead, name in LOST or name not in INSTEAD))
