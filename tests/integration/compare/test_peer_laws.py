"""Laws of other programs in ours: stresses by the formulas of both, energies by differences; values in time; XML."""

import math
import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path

from fsi_compare.base.errors import InputError
from fsi_compare.base.toml import toml_lines, toml_value
from fsi_compare.peer_cases.case_file import case_text
from fsi_compare.peer_cases.geometry import plain_names
from fsi_compare.peer_cases.model import PeerCase
from fsi_compare.peer_cases.svmultiphysics_laws import layer_of, viscosity_of
from fsi_compare.peer_cases.units import CGS, SYSTEMS
from fsi_compare.peer_cases.waveforms import read_coefficients, read_series
from fsi_compare.peer_cases.xml_file import read_xml

I = np.eye(3)


def energy_of_svmultiphysics(law, penalty, values, c, fibres=()):
    """Its energies: the stress of mat_models.cpp is twice the derivative of these by C (see Stresses below)."""
    young, nu = values["E"], values["nu"]
    mu, bulk = young / (2 * (1 + nu)), values.get("Kp", young / (3 * (1 - 2 * nu)))
    j = math.sqrt(np.linalg.det(c))
    i1, i2 = np.trace(c), 0.5 * (np.trace(c) ** 2 - np.trace(c @ c))
    j1, j2 = i1 * j ** (-2 / 3), i2 * j ** (-4 / 3)
    volume = {
        "quad": bulk / 2 * (j - 1) ** 2,
        "ST91": bulk / 2 * ((j * j - 1) / 2 - math.log(j)),
        "M94": bulk * (j - 1 - math.log(j)),
    }[penalty]
    if law == "neoHookean":
        return mu / 2 * (j1 - 3) + volume
    if law == "MR":
        return values["c1"] * (j1 - 3) + values["c2"] * (j2 - 3) + volume
    if law == "stVK":
        e = (c - I) / 2
        lame = young * nu / ((1 + nu) * (1 - 2 * nu))
        return lame / 2 * np.trace(e) ** 2 + mu * np.sum(e * e) + volume
    assert law == "HGO"
    kappa, total = values["kappa"], mu / 2 * (j1 - 3) + volume
    for a, (stiffness, exponent) in zip(fibres, families_of(values)):
        strain = kappa * j1 + (1 - 3 * kappa) * j ** (-2 / 3) * (a @ c @ a) - 1
        total += stiffness / (2 * exponent) * (math.exp(exponent * strain**2) - 1)
    return total


def families_of(values):
    return (values["a4"], values["b4"]), (values["a6"], values["b6"])


def stress_of_svmultiphysics(law, penalty, values, c, fibres=()):
    """The second Piola-Kirchhoff stress, written as compute_pk2cc has it: of a fictitious stress its isochoric part,
    J^(-2/3) Dev, and the penalty's p J C^-1."""
    young, nu = values["E"], values["nu"]
    mu, bulk = young / (2 * (1 + nu)), values.get("Kp", young / (3 * (1 - 2 * nu)))
    j = math.sqrt(np.linalg.det(c))
    inverse = np.linalg.inv(c)
    p = {"quad": bulk * (j - 1), "ST91": bulk / 2 * (j - 1 / j), "M94": bulk * (1 - 1 / j)}[penalty]
    volumetric = p * j * inverse
    if law == "stVK":
        e = (c - I) / 2
        lame = young * nu / ((1 + nu) * (1 - 2 * nu))
        return volumetric + lame * np.trace(e) * I + 2 * mu * e
    isochoric = j ** (-2 / 3) * np.trace(c)
    if law in ("neoHookean", "nHK"):
        bar = mu * I
    elif law == "MR":
        bar = 2 * (values["c1"] + isochoric * values["c2"]) * I - 2 * values["c2"] * j ** (-2 / 3) * c
    else:
        kappa, bar = values["kappa"], mu * I
        for a, (stiffness, exponent) in zip(fibres, families_of(values)):
            tensor = kappa * I + (1 - 3 * kappa) * np.outer(a, a)
            strain = kappa * isochoric + (1 - 3 * kappa) * j ** (-2 / 3) * (a @ c @ a) - 1
            bar = bar + 2 * stiffness * strain * math.exp(exponent * strain**2) * tensor
    return volumetric + j ** (-2 / 3) * (bar - np.sum(bar * c) / 3 * inverse)


def stress_of_ours(layer, c, fibres=()):
    """By docs/theory.md, sections 5.1 to 5.7, from the constants of the case file."""
    made = layer.constants
    j = math.sqrt(np.linalg.det(c))
    third, inverse = j ** (-2 / 3), np.linalg.inv(c)
    i1, i2 = np.trace(c), 0.5 * (np.trace(c) ** 2 - np.trace(c @ c))
    if made["material"] == "saint-venant-kirchhoff":
        e = (c - I) / 2
        return 2 * made["lame_mu"] * e + made["lame_lambda"] * np.trace(e) * I
    if made["material"] == "neo-hookean":
        young, nu = made["young"], made["poisson"]
        mu, bulk = young / (2 * (1 + nu)), young / (3 * (1 - 2 * nu))
    else:
        mu, bulk = made["c10"], layer.bulk_modulus
    stress = bulk * (j - 1) * j * inverse + mu * third * (I - i1 / 3 * inverse)
    if made["material"] == "mooney-rivlin":
        stress = stress + made["c01"] * third**2 * (i1 * I - c - 2 / 3 * i2 * inverse)
    second = {name: made.get(f"{name}_second", made.get(name)) for name in ("k1", "k2")}
    for a, family in zip(fibres, (made, second)):
        kappa = made.get("kappa", 0.0)
        d1 = third * (I - i1 / 3 * inverse)
        d4 = third * (np.outer(a, a) - (a @ c @ a) / 3 * inverse)
        strain = kappa * (third * i1 - 3) + (1 - 3 * kappa) * (third * (a @ c @ a) - 1)
        factor = 2 * family["k1"] * math.exp(family["k2"] * strain**2) * strain
        stress = stress + factor * (kappa * d1 + (1 - 3 * kappa) * d4)
    return stress


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.base = Path(folder.name)

    def xml(self, text):
        (self.base / "a.xml").write_text(text)
        return read_xml(self.base / "a.xml")

    def domain(self, law, penalty, **values):
        inner = "".join(f"<{k}>{v!r}</{k}>" for k, v in values.items() if k not in ("E", "nu", "Kp"))
        text = f'<Domain id="1"><Constitutive_model type="{law}">{inner}</Constitutive_model><Density>1.1</Density>'
        text += (
            f"<Elasticity_modulus>{values['E']!r}</Elasticity_modulus><Poisson_ratio>{values['nu']!r}</Poisson_ratio>"
        )
        text += f"<Dilational_penalty_model>{penalty}</Dilational_penalty_model>"
        text += f"<Penalty_parameter>{values['Kp']!r}</Penalty_parameter>" if "Kp" in values else ""
        return self.xml(text + "</Domain>")


def deformations(count, size, seed=4):
    """C of random gradients of this size that are no rotation."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        f = I + size * random.uniform(-1, 1, (3, 3))
        yield f.T @ f


FIBRES = [np.array([0.0, math.cos(0.5), sign * math.sin(0.5)]) for sign in (1, -1)]


class Stresses(Files):
    def test_the_formulas_here_are_one_law(self):
        """Energy and stress as this file writes them: S = 2 dW/dC."""
        values = {"E": 3e6, "nu": 0.4, "c1": 4e5, "c2": 2e5, "a4": 1e5, "b4": 2.0, "a6": 4e5, "b6": 1.0, "kappa": 0.1}
        for law in ("neoHookean", "MR", "stVK", "HGO"):
            for penalty in ("quad", "ST91", "M94"):
                for c in deformations(2, 0.2):
                    stress = stress_of_svmultiphysics(law, penalty, values, c, FIBRES)
                    for a, b in ((0, 0), (1, 2), (0, 2)):
                        d = np.zeros((3, 3))
                        d[a, b] = d[b, a] = 1e-6
                        energies = [energy_of_svmultiphysics(law, penalty, values, x, FIBRES) for x in (c + d, c - d)]
                        slope = (energies[0] - energies[1]) / 2e-6 * (1 if a != b else 2)
                        self.assertAlmostEqual(slope, stress[a, b], delta=2e-6 * values["E"])

    def same(self, law, angle=None, size=0.2, **values):
        layer = layer_of(self.domain(law, "quad", **values), "struct", CGS, angle)
        fibres = FIBRES if law == "HGO" else ()
        for c in deformations(40, size):
            theirs = 1e-4 * stress_of_svmultiphysics(law, "quad", values, c, fibres)
            ours = stress_of_ours(layer, c, fibres)
            np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max() + 1e-13 * values["E"])
        return layer

    def test_neo_hookean(self):
        layer = self.same("neoHookean", E=4e6, nu=0.45)
        self.assertEqual(layer.constants, {"material": "neo-hookean", "young": 400.0, "poisson": 0.45})
        self.assertEqual(layer.notes, [])
        self.same("nHK", E=4e6, nu=0.45, Kp=7e7)

    def test_mooney_rivlin(self):
        layer = self.same("MR", E=4e6, nu=0.45, c1=3e5, c2=1e5)
        self.assertAlmostEqual(layer.constants["c10"], 60.0)

    def test_fibres(self):
        layer = self.same("HGO", 28.6, size=0.1, E=4e6, nu=0.49, a4=2e4, b4=0.8, a6=2e4, b6=0.8, kappa=0.1)
        self.assertNotIn("k1_second", layer.constants)
        self.assertIn("not by the vectors", layer.notes[0][1])
        with self.assertRaisesRegex(InputError, "--fibre-angle"):
            self.same("HGO", E=4e6, nu=0.49, a4=2e4, b4=0.8, a6=2e4, b6=0.8, kappa=0.1)
        layer = self.same("HGO", 28.6, E=4e6, nu=0.49, a4=2e4, b4=0.8, a6=3e4, b6=0.9, kappa=0.1)
        self.assertAlmostEqual(layer.constants["k1_second"], 3.0)
        self.assertEqual(layer.constants["k2_second"], 0.9)

    def test_saint_venant_and_kirchhoff_without_the_penalty(self):
        layer = self.same("stVK", E=4e6, nu=0.3, Kp=0.0)
        self.assertEqual(layer.notes, [])

    def test_with_the_penalty_it_is_the_same_at_small_strain(self):
        values = {"E": 4e6, "nu": 0.3}
        layer = layer_of(self.domain("stVK", "ST91", **values), "struct", CGS, None)
        for size in (1e-3, 1e-4):
            for c in deformations(5, size):
                theirs = 1e-4 * stress_of_svmultiphysics("stVK", "ST91", values, c)
                off = np.abs(stress_of_ours(layer, c) - theirs).max() / np.abs(theirs).max()
                self.assertLess(off, 20 * size)
        self.assertTrue(layer.notes[0][2])

    def test_other_penalties_differ_as_is_said(self):
        for penalty, share in (("ST91", 0.5), ("M94", 1.0)):
            layer = layer_of(self.domain("neoHookean", penalty, E=4e6, nu=0.45), "struct", CGS, None)
            self.assertIn(f"differ by {share:g} % of themselves", layer.notes[0][1])
            c = 1.01 ** (2 / 3) * I  # a change of volume alone, of 1 %
            theirs = 1e-4 * stress_of_svmultiphysics("neoHookean", penalty, {"E": 4e6, "nu": 0.45}, c)[0, 0]
            ours = stress_of_ours(layer, c)[0, 0]
            self.assertAlmostEqual(1 - theirs / ours, share / 100, delta=0.02 * share / 100)

    def test_viscosities(self):
        text = '<D><Viscosity model="{}">{}</Viscosity></D>'
        law = viscosity_of(self.xml(text.format("Constant", "<Value>0.04</Value>")), CGS)[0]
        self.assertAlmostEqual(law["viscosity"], 4e-3, delta=1e-17)
        parts = "<Limiting_high_shear_rate_viscosity>0.022</Limiting_high_shear_rate_viscosity>"
        parts += "<Limiting_low_shear_rate_viscosity>0.22</Limiting_low_shear_rate_viscosity>"
        parts += "<Power_law_index>0.392</Power_law_index>"
        parts += "<Shear_rate_tensor_multiplier>0.11</Shear_rate_tensor_multiplier>"
        parts += "<Shear_rate_tensor_exponent>0.644</Shear_rate_tensor_exponent>"
        made = viscosity_of(self.xml(text.format("Carreau-Yasuda", parts)), CGS)[0]["viscosity_model"]
        for rate in (0.0, 3.0, 500.0):  # 1/s
            theirs = 0.1 * (0.022 + (0.22 - 0.022) * (1 + (0.11 * rate) ** 0.644) ** ((0.392 - 1) / 0.644))
            x = (made["lambda"] * rate / 1000) ** made["a"]
            ours = made["mu_inf"] + (made["mu0"] - made["mu_inf"]) * (1 + x) ** ((made["n"] - 1) / made["a"])
            self.assertAlmostEqual(ours, theirs, delta=1e-14)
        parts = "<Asymptotic_viscosity_parameter>0.3953</Asymptotic_viscosity_parameter>"
        parts += "<Yield_stress_parameter>0.22803</Yield_stress_parameter>"
        made = viscosity_of(self.xml(text.format("Cassons", parts)), CGS)[0]["viscosity_model"]
        plastic, stress, m = (made[key] for key in ("plastic_viscosity", "yield_stress", "regularisation"))
        for rate in (0.0, 1e4):
            theirs = 0.1 * (0.3953 + 0.22803 / math.sqrt(max(rate, 0.5))) ** 2
            g = rate / 1000
            part = math.sqrt(stress / g) * (1 - math.exp(-math.sqrt(m * g))) if g else math.sqrt(stress * m)
            self.assertAlmostEqual((math.sqrt(plastic) + part) ** 2, theirs, delta=1e-6 * theirs)


class Values(Files):
    def test_units(self):
        self.assertEqual((CGS.pressure, CGS.viscosity, CGS.flow), (1e-4, 0.1, 1.0))
        self.assertEqual((CGS.resistance, CGS.compliance, CGS.spring, CGS.damper), (1e-4, 1e7, 1e-5, 0.01))
        si = SYSTEMS["si"]
        self.assertEqual((si.density, si.pressure, si.viscosity, si.flow), (1e-3, 1e-3, 1.0, 1e6))
        self.assertEqual((si.resistance, si.compliance), (1e-9, 1e12))

    def test_a_series_of_many_modes_is_its_points(self):
        times = np.linspace(0, 0.8, 41)
        values = 2 + 3 * times + np.sin(2 * np.pi * times / 0.8) ** 3
        (self.base / "a.flow").write_text("41 400\n" + "".join(f"{t} {v}\n" for t, v in zip(times, values)))
        wave, error = read_series(self.base / "a.flow", False)
        self.assertLess(error, 1e-3)
        rows = np.array(wave.rows())
        self.assertAlmostEqual(rows[-1, 0], 0.8)
        np.testing.assert_allclose(np.interp(times, *rows.T), values, atol=2e-3)

    def test_coefficients_are_those_of_the_series(self):
        """A file of coefficients that say what a series has is the same function."""
        times = np.linspace(0, 1, 65)
        values = 1 - np.cos(2 * np.pi * times)
        (self.base / "a.flow").write_text("65 3\n" + "".join(f"{t} {v}\n" for t, v in zip(times, values)))
        wave, _ = read_series(self.base / "a.flow", False)
        lines = ["0.0 1.0", "0.0 0.0", "3"] + [
            f"{r!r} {i!r}" for r, i in zip(wave.real.tolist(), wave.imaginary.tolist())
        ]
        (self.base / "a.fcs").write_text("\n".join(lines) + "\n")
        np.testing.assert_array_equal(read_coefficients(self.base / "a.fcs").rows(), wave.rows())
        self.assertAlmostEqual(wave.real[0], 1.0, delta=1e-12)
        self.assertAlmostEqual(wave.real[1], -1.0, delta=1e-3)

    def test_a_ramp_ends_with_its_last_value(self):
        (self.base / "a.dat").write_text("2 1\n0 0\n2 5\n")
        wave, _ = read_series(self.base / "a.dat", True)
        self.assertEqual(wave.rows(), [(0.0, 0.0), (2.0, 5.0)])

    def test_files_that_are_wrong(self):
        for text, words in (
            ("", "no number of points"),
            ("3 2\n0 1\n1 2\n", "says 3 points, there are 2"),
            ("2 2\n1 1\n1 2\n", "do not rise"),
            ("2 0\n0 1\n1 2\n", "says 0 modes"),
            ("2 2\n0 1 1\n1 2\n", "has 3 numbers"),
            ("2 2\n0 1\n1 x\n", "line 3"),
        ):
            (self.base / "a.flow").write_text(text)
            with self.assertRaisesRegex(InputError, words):
                read_series(self.base / "a.flow", False)
        with self.assertRaisesRegex(InputError, "is missing"):
            read_series(self.base / "none.flow", False)

    def test_names(self):
        given = ["a b", "inner", "symmetry_x", "a_b", "fluid", "lumen"]
        self.assertEqual(
            plain_names(given, ["lumen"]),
            ["a_b", "face_inner", "face_symmetry_x", "face_a_b", "face_fluid", "face_lumen"],
        )

    def test_values_as_toml(self):
        self.assertEqual(toml_value({"a": [1.0, True, 'x"y']}), '{ a = [1.0, true, "x\\"y"] }')
        texts = {"a": "tab\there", "b c": 'say "C:\\x"', "d": ["\x1b", "\U000f0000"]}
        self.assertEqual(tomllib.loads("\n".join(toml_lines(texts))), texts)
        self.assertEqual(toml_value("cut \udc80"), '"cut \ufffd"')  # a byte of a file's name that is no UTF-8

    def test_case_file(self):
        case = PeerCase("other", Path("two\nlines.xml"), {"title": "a\nb", "mesh": {"file": "m.msh", "x": 0.1 + 0.2}})
        self.assertEqual(tomllib.loads(case_text(case)), {"title": "a\nb", "mesh": {"file": "m.msh", "x": 0.3}})


class Xml(Files):
    def test_no_document_type_is_taken(self):
        """Neither an entity that grows nor one from outside: the document type itself is refused, before either."""
        (self.base / "secret").write_text("secret")
        laughs = '<!DOCTYPE a [<!ENTITY x "ha"><!ENTITY y "&x;&x;">]><a>&y;</a>'
        outside = '<!DOCTYPE a [<!ENTITY x SYSTEM "secret">]><a>&x;</a>'
        for text in (laughs, outside, '<!DOCTYPE a SYSTEM "a.dtd"><a/>'):
            with self.assertRaisesRegex(InputError, "line 1: has a document type"):
                self.xml(text)

    def test_what_is_no_xml(self):
        for text in ("", "<a>", "<a></b>", "<a>&x;</a>", "plain"):
            with self.assertRaisesRegex(InputError, "is no XML"):
                self.xml(text)
        with self.assertRaisesRegex(InputError, "levels"):
            self.xml("<a>" * 60 + "</a>" * 60)

    def test_places_and_values(self):
        root = self.xml('<r>\n<Add_BC name="in">\n<Value> 1e3 </Value><Flux>yes</Flux></Add_BC></r>')
        (entry,) = root.all("Add_BC")
        self.assertEqual(entry.number("Value"), 1000.0)
        with self.assertRaisesRegex(InputError, "line 3: Add_BC in/Flux: 'yes' is neither true nor false"):
            entry.yes("Flux", False)
        with self.assertRaisesRegex(InputError, "line 2: Add_BC in: has no Type"):
            entry.need("Type")
        self.assertEqual([e.name for e in root.every() if not e.taken], [])


if __name__ == "__main__":
    unittest.main()
