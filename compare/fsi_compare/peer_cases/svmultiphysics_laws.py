"""Material laws of svMultiPhysics in ours, with the constants of the same energy. Its sources: set_material_props.h,
mat_models.cpp (compute_pk2cc, compute_svol_p), read_mat_model of read_files.cpp, fluid.cpp (get_viscosity).

With J_1, J_2, J_i the isochoric invariants, mu = E/(2 (1 + nu)), K = E/(3 (1 - 2 nu)) or Penalty_parameter:

    neoHookean   mu/2 (J_1 - 3)                              ours: c10/2 (J_1 - 3)
    MR           c1 (J_1 - 3) + c2 (J_2 - 3)                 ours: c10/2 (J_1 - 3) + c01/2 (J_2 - 3)
    HGO          mu/2 (J_1 - 3) + sum a/(2 b) (exp(b E_i^2) - 1),  E_i = kappa J_1 + (1 - 3 kappa) J_i - 1, as
                 ours, holzapfel-gasser-ogden
    stVK         lambda/2 (tr E)^2 + mu E : E, beside which the penalty stands, too

and the penalty of a change of volume, of which ours has the first:

    quad   K/2 (J - 1)^2       ST91   K/2 ((J^2 - 1)/2 - ln J)       M94   K (J - 1 - ln J)
"""

from dataclasses import dataclass, field
from typing import Any

from .units import Units
from .xml_file import Entry

LAWS = dict.fromkeys(("nHK", "nHK91", "neoHookean", "neoHookeanSimo91"), "neoHookean")
LAWS |= dict.fromkeys(("stVK", "stVenantKirchhoff"), "stVK") | dict.fromkeys(("MR", "Mooney-Rivlin"), "MR")
LAWS["HGO"] = "HGO"
# Of the same program, without a law of ours that has their energy.
MODIFIED = ("m-stVK", "modified-stVK", "modified-stVenantKirchhoff")
HOLZAPFEL_OGDEN = ("HO", "HolzapfelOgden", "HO_ma", "HolzapfelOgden-ModifiedAnisotropy")
OTHERS = dict.fromkeys(MODIFIED, "a modified law of St. Venant and Kirchhoff")
OTHERS |= dict.fromkeys(HOLZAPFEL_OGDEN, "Holzapfel and Ogden's law of the heart")
OTHERS |= dict.fromkeys(("Guccione", "Gucci"), "Guccione's law of the heart")
OTHERS |= dict.fromkeys(("lin", "linear"), "a stress mu I without strain")
OTHERS |= dict.fromkeys(("CANN", "AnisoHyper"), "a law by a network")
PENALTIES = dict.fromkeys(("quad", "Quad", "quadratic", "Quadratic"), "quad")
PENALTIES |= dict.fromkeys(("ST91", "Simo-Taylor91"), "ST91") | dict.fromkeys(("M94", "Miehe94"), "M94")
# By how much of itself the penalty's pressure is below K (J - 1), per change of volume, J - 1.
SHORT_OF = {"quad": 0.0, "ST91": 0.5, "M94": 1.0}
NEARLY = 1e4  # K/mu in the place of an incompressible wall: nu = 0.49995


@dataclass
class Layer:
    """`constants` of [structure.layers.NAME]; `bulk_modulus` where the law takes that of [structure]; notes: entry,
    what is done, whether it matters."""

    constants: dict[str, Any]
    density: float
    bulk_modulus: float | None = None
    notes: list[tuple[Entry, str, bool]] = field(default_factory=list)


@dataclass
class Wall:
    """What a law is made of: its entry, the moduli in kPa, and how the case's fibres lie."""

    at: Entry
    mu: float
    bulk: float
    nu: float
    units: Units
    fibre_angle: float | None

    def require_bulk(self) -> None:
        if self.bulk <= 0:
            problem = "has no bulk modulus: svMultiPhysics adds no volumetric stress then"
            raise self.at.refuse(problem, "give Poisson_ratio below 0.5 or a Penalty_parameter")


def young_and_poisson(mu: float, bulk: float) -> tuple[float, float]:
    """Young's modulus and Poisson's ratio of a shear and a bulk modulus."""
    return 9 * bulk * mu / (3 * bulk + mu), (3 * bulk - 2 * mu) / (2 * (3 * bulk + mu))


def layer_of(domain: Entry, equation: str, units: Units, fibre_angle: float | None) -> Layer:
    """A layer from the domain of a wall. Raises InputError for what has no counterpart."""
    density = domain.number("Density", 0.5) * units.density
    if density <= 0:
        remedy = "give one above 0; a wall without inertia is [static] of ours"
        raise domain.refuse(f"has the density {density:g}", remedy)
    young, nu = domain.number("Elasticity_modulus", 1e7), domain.number("Poisson_ratio", 0.3)
    layer = Layer({}, density)
    for name, value in (("Elasticity_modulus", 1e7), ("Poisson_ratio", 0.3), ("Density", 0.5)):
        if not domain.all(name):
            layer.notes.append((domain, f"has no {name}: {value:g}, its program's default", True))
    if not (young > 0 and -1 < nu <= 0.5):
        raise domain.refuse(f"has the modulus {young:g} and Poisson's ratio {nu:g}", "give E > 0 and -1 < nu <= 0.5")
    young *= units.pressure
    if equation == "lElas":
        if nu >= 0.5:
            raise domain.refuse("is incompressible, Poisson_ratio 0.5", "give less than 0.5")
        layer.constants = {"material": "linear-elastic", "young": young, "poisson": nu}
        return layer
    model = domain.find("Constitutive_model")
    given = model.attributes.get("type", "").strip() if model else "neoHookean"
    if model is None:
        layer.notes.append((domain, "has no Constitutive_model: neoHookean, its program's default", False))
    at = model or domain
    if given in OTHERS:
        raise at.refuse(f"{given} is {OTHERS[given]}, which no material of ours has", "set up the case by hand")
    if given not in LAWS:
        raise at.refuse(f"'{given}' is no constitutive model", f"there are {', '.join(LAWS)}")
    mu = young / (2 * (1 + nu))
    bulk = _bulk_modulus(domain, equation, young, nu, units, layer)
    MAKERS[LAWS[given]](Wall(at, mu, bulk, nu, units, fibre_angle), layer)
    if LAWS[given] == "neoHookean" and not domain.all("Penalty_parameter") and nu < 0.5:
        layer.constants |= {"young": young, "poisson": nu}
    _penalty(domain, at, layer)
    _viscosity(domain, units, layer)
    return layer


def _bulk_modulus(domain: Entry, equation: str, young: float, nu: float, units: Units, layer: Layer) -> float:
    given = domain.find("Penalty_parameter")
    if given is not None:
        bulk = given.as_number() * units.pressure
        if bulk < 0:
            raise given.refuse(f"{given.text} is negative", "give the bulk modulus")
        if bulk > 0:
            return bulk
    elif nu < 0.5 - 1e-14:
        return young / (3 * (1 - 2 * nu))
    if equation == "ustruct":
        layer.notes.append((domain, f"is incompressible: nearly so here, a bulk modulus of {NEARLY:g} mu", True))
        return NEARLY * young / (2 * (1 + nu))
    return 0.0


def _neo_hookean(wall: Wall, layer: Layer) -> None:
    wall.require_bulk()
    young, poisson = young_and_poisson(wall.mu, wall.bulk)
    layer.constants = {"material": "neo-hookean", "young": young, "poisson": poisson}


def _mooney_rivlin(wall: Wall, layer: Layer) -> None:
    wall.require_bulk()
    c1, c2 = (2 * wall.at.number(name) * wall.units.pressure for name in ("c1", "c2"))
    layer.constants = {"material": "mooney-rivlin", "c10": c1, "c01": c2}
    layer.bulk_modulus = wall.bulk


def _saint_venant(wall: Wall, layer: Layer) -> None:
    at, mu, bulk, nu = wall.at, wall.mu, wall.bulk, wall.nu
    if nu >= 0.5:
        raise at.refuse("stVK is incompressible, Poisson_ratio 0.5", "give less than 0.5")
    lame = 2 * mu * nu / (1 - 2 * nu)
    layer.constants = {"material": "saint-venant-kirchhoff", "lame_lambda": lame + bulk, "lame_mu": mu}
    if bulk > 0:
        words = f"svMultiPhysics adds a penalty of {bulk:.6g} kPa to stVK's own lambda of {lame:.6g}: lame_lambda is "
        words += "their sum, the same at small strain; Penalty_parameter 0 there is the law itself"
        layer.notes.append((at, words, True))


def _two_families(wall: Wall, layer: Layer) -> None:
    wall.require_bulk()
    at, angle, pressure = wall.at, wall.fibre_angle, wall.units.pressure
    a4, b4, a6, b6, kappa = (at.number(name) for name in ("a4", "b4", "a6", "b6", "kappa"))
    if angle is None:
        problem = "gives fibres by vectors, holzapfel-gasser-ogden of ours by their angle to the circumference"
        raise at.refuse(problem, "give --fibre-angle DEGREES")
    fibres = {"k1": a4 * pressure, "k2": b4, "alpha": angle}
    layer.constants = {"material": "holzapfel-gasser-ogden", "c10": wall.mu, **fibres}
    if a4 != a6 or b4 != b6:
        layer.constants |= {"k1_second": a6 * pressure, "k2_second": b6}
    if kappa:
        layer.constants["kappa"] = kappa
    layer.bulk_modulus = wall.bulk
    words = f"fibres lie at {angle:g} degrees to the circumference (--fibre-angle), not by the vectors of the case; "
    words += "the first family at plus, the second at minus that angle"
    layer.notes.append((at, words, True))


MAKERS = {"neoHookean": _neo_hookean, "MR": _mooney_rivlin, "stVK": _saint_venant, "HGO": _two_families}


def _penalty(domain: Entry, at: Entry, layer: Layer) -> None:
    entry = domain.find("Dilational_penalty_model")
    given = entry.text if entry else "ST91"
    if given not in PENALTIES:
        raise (entry or domain).refuse(f"'{given}' is no penalty model", f"there are {', '.join(PENALTIES)}")
    short = SHORT_OF[PENALTIES[given]]
    if short and layer.constants["material"] != "saint-venant-kirchhoff":
        own = given if entry else f"{given}, its program's default"
        words = f"{own}: K/2 (J - 1)^2 of the same bulk modulus here; their pressures differ by {short:g} % of "
        layer.notes.append((entry or at, words + "themselves for each per cent that the volume changes", True))


def _viscosity(domain: Entry, units: Units, layer: Layer) -> None:
    found = domain.find("Viscosity")
    if found is None:
        return
    model = found.attributes.get("model", "").strip()
    value = found.number("Value", 0.0) * units.viscosity
    if value == 0:
        return
    if model.lower() != "potential":
        problem = f"'{model}' is no viscosity of a wall that ours has"
        raise found.refuse(problem, 'write model="Potential", which is viscosity of a layer of ours, or leave it out')
    layer.constants["viscosity"] = value


def viscosity_of(domain: Entry, units: Units) -> tuple[dict[str, Any], list[tuple[Entry, str, bool]]]:
    """Keys of [fluid], and notes. Raises InputError."""
    entry = domain.need("Viscosity")
    model = entry.attribute("model")
    mu = units.viscosity
    seconds = units.time
    kind = model.lower()
    if kind in ("const", "constant", "newtonian"):
        return {"viscosity": entry.positive("Value") * mu}, []
    if kind in ("cy", "carreau-yasuda"):
        # The program's list of keys has "multiplier"; older files "multipler".
        at_rest = entry.positive("Limiting_low_shear_rate_viscosity") * mu
        high = entry.positive("Limiting_high_shear_rate_viscosity") * mu
        law: dict[str, Any] = {"name": "carreau-yasuda", "mu0": at_rest, "mu_inf": high}
        law["lambda"] = entry.positive("Shear_rate_tensor_multiplier") * seconds
        law["a"], law["n"] = entry.positive("Shear_rate_tensor_exponent"), entry.number("Power_law_index")
        return {"viscosity_model": law}, []
    if kind in ("cass", "cassons"):
        plastic = entry.positive("Asymptotic_viscosity_parameter") * mu**0.5
        stress, threshold = entry.positive("Yield_stress_parameter"), entry.find("Low_shear_rate_threshold")
        lowest = 0.5 if threshold is None else threshold.positive()
        law = {"name": "casson", "yield_stress": stress**2 * units.pressure, "plastic_viscosity": plastic**2}
        law["regularisation"] = seconds / lowest
        words = f"below {lowest:g} per unit of time its viscosity is constant; here it goes to the same value smoothly "
        words += "(regularisation), 1 - exp(-sqrt(m g)) in place of a corner"
        return {"viscosity_model": law}, [(entry, words, True)]
    raise entry.refuse(f"'{model}' is no viscosity model", "there are Constant, Carreau-Yasuda and Cassons")
