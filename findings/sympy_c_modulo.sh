#!/usr/bin/env bash
# Mod(t, T) of SymPy, the time within a cycle, is another function in the C and C++ that SymPy writes. In SymPy, and in
# its Python, NumPy and Fortran, it lies between 0 and T. In C it is fmod(t, T), which has the sign of t: with a shift,
# Mod(t - d, T), times before d have a phase below 0, and a valve that is open while the phase is small is open there,
# too. Of integers C has the right expression, ((i % n) + n) % n. Where the shift is a number, SymPy adds a period to
# it, and the same formula is right from t = 0 on. So tests by such show nothing. The other way to write it,
# T*frac(t/T), loses brackets: in Python it is T*(t/T) % 1, and in C of 1.11.1 only one part of frac is multiplied by T.
# With NumPy, and in C of 1.13.3, it is right. Nothing is said of any of it. t - T*floor(t/T) is right in all of them.
# A guess would be that all printers write the same function, as those of Fortran and JavaScript see to it.
# Seen with 1.11.1 (Debian 12) and 1.13.3 (Debian 13): t = 0.1, d = 0.3, T = 0.8, phase 0.6; the valve is open below
# 0.3.
# Output seen of both: phase: SymPy, Python, NumPy, Fortran 0.6, C -0.2; valve: all 0, C 1; by floor: all 0.6; by frac:
# SymPy and NumPy 0.6, Python 0.8, C 0.55, of 1.13.3 0.6; shift 0.3: C 0.6; integers -1 and 3: C 2.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-sympy=1.11.1-1 python3-numpy gcc=4:12.2.0-3 gfortran=4:12.2.0-3 libc6-dev
debian trixie "$scratch/13" python3-sympy=1.13.3-5 python3-numpy gcc=4:14.2.0-1 gfortran=4:14.2.0-1 libc6-dev
for root in 12 13; do
  cat >"$scratch/$root/root/phase.py" <<'END'
import subprocess

import sympy
from sympy import Mod, Piecewise, ccode, cxxcode, fcode, floor, frac, jscode, lambdify, symbols

t, d = symbols("t d", real=True)
T = symbols("T", positive=True)
values = {t: 0.1, d: 0.3, T: 0.8}
i, n = symbols("i n", integer=True)


def run(source, name, compiler):
    with open(f"/root/{name}", "w") as file:
        file.write(source)
    subprocess.run([compiler, f"/root/{name}", "-o", "/root/phase", "-lm"], check=True)
    return float(subprocess.run(["/root/phase"], check=True, capture_output=True, text=True).stdout)


def by_c(formula, numbers=values, kind="double"):
    numbers = "".join(f"const {kind} {symbol} = {value};\n" for symbol, value in numbers.items())
    start = f"#include <math.h>\n#include <stdio.h>\n{numbers}int main(void) {{\n"
    return run(f'{start}  printf("%.15g\\n", (double)({ccode(formula)}));\n}}\n', "phase.c", "gcc")


def by_fortran(formula):
    # Fortran takes t and T for the same name.
    renamed = {t: symbols("time", real=True), T: symbols("cycle", positive=True)}
    numbers = {renamed.get(symbol, symbol): value for symbol, value in values.items()}
    formula = formula.xreplace(renamed)
    lines = "".join(f"double precision, parameter :: {name} = {value}d0\n" for name, value in numbers.items())
    text = fcode(formula, standard=95, source_format="free")
    return run(f"program phase\n{lines}write (*, '(f20.15)') {text}\nend program\n", "phase.f90", "gfortran")


print(f"SymPy {sympy.__version__}")
phase = Mod(t - d, T)
print("C", ccode(Mod(t, T)), "C++", cxxcode(Mod(t, T)), "JavaScript", jscode(Mod(t, T)))
valve = Piecewise((1, phase < 0.3), (0, True))
shift = t - d
formulas = {"phase": phase, "valve": valve, "floor": shift - T * floor(shift / T), "frac": T * frac(shift / T)}
for name, formula in formulas.items():
    print(f"{name}: SymPy {float(formula.subs(values)):.3g}", end="")
    for module in ("math", "numpy"):
        print(f", {module} {float(lambdify(list(values), formula, module)(*values.values())):.3g}", end="")
    if name == "phase":
        print(f", Fortran {by_fortran(formula):.3g}", end="")
    print(f", C {by_c(formula):.3g}")
print(f"shift 0.3: C {by_c(Mod(t - 0.3, 0.8), {t: 0.1}):.3g}")
print(f"integers: C {by_c(Mod(i, n), {i: -1, n: 3}, 'int'):.3g}")
END
  within "$scratch/$root" python3 /root/phase.py >"$scratch/$root/said" 2>"$scratch/log" ||
    fail "python ends with $(cat "$scratch/log")"
  [ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
  cat "$scratch/$root/said"
done
expected() {
  cat <<END
SymPy $1
C fmod(t, T) C++ std::fmod(t, T) JavaScript ((t % T) + T) % T
phase: SymPy 0.6, math 0.6, numpy 0.6, Fortran 0.6, C -0.2
valve: SymPy 0, math 0, numpy 0, C 1
floor: SymPy 0.6, math 0.6, numpy 0.6, C 0.6
frac: SymPy 0.6, math 0.8, numpy 0.6, C $2
shift 0.3: C 0.6
integers: C 2
END
}
expected 1.11.1 0.55 | diff "$scratch/12/said" - || fail "what 1.11.1 writes"
expected 1.13.3 0.6 | diff "$scratch/13/said" - || fail "what 1.13.3 writes"
