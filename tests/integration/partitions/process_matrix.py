"""Every element and geometry, material, driver and linear solver on 2, 3, 4 and 8 processes against one: what CI takes in
turn. Prints tables for docs/guide/clusters.md. By `cmake --build --preset release --target process_matrix`, in six minutes;
FSI_MATRIX_PROCESSES="2 3" for other numbers of processes, FSI_MATRIX_ITERATED=1 for iterated systems alone."""

import os
from pathlib import Path

from programs import DRIVERS
from scenes import KINDS
from test_partitions import BOUND, ITERATION, MATERIALS, PETSC, Processes, apart

NUMBERS = [int(number) for number in os.environ.get("FSI_MATRIX_PROCESSES", "2 3 4 8").split()]
METHODS = {"factorised at the first process": (), "iterated": (ITERATION,), "by `petsc`": (PETSC,)}
if os.environ.get("FSI_MATRIX_ITERATED"):
    METHODS = {"iterated": (ITERATION,)}


class ProcessMatrix(Processes):
    def test_pressure_is_that_of_one_process(self):
        worst = {}
        for kind in KINDS:
            for program in DRIVERS:
                for case in MATERIALS:
                    alone = self.march(program, case, kind, None)
                    for method, settings in METHODS.items():
                        for number in NUMBERS:
                            with self.subTest(kind=kind, program=program, case=case.stem, method=method, number=number):
                                found = apart(self.march(program, case, kind, number, *settings), alone)
                                place = (method, kind, program, number)
                                worst[place] = max(found, worst.get(place, 0))
                                print(
                                    *kind, Path(program).name, case.stem, method, f"{number}: {found:.1e}", flush=True
                                )
                                self.assertLess(found, BOUND)
        for method in METHODS:
            print(f"\n| element, geometry, {method} | driver |", *(f"{number} processes |" for number in NUMBERS))
            print("|---|---|" + "---|" * len(NUMBERS))
            for kind in KINDS:
                for program in DRIVERS:
                    cells = (f"{worst.get((method, kind, program, number), 1):.0e} |" for number in NUMBERS)
                    print(f"| {', '.join(kind)} | `{Path(program).name}` |", *cells)
