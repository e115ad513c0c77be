"""Modified Bessel functions, of which numpy has the order 0 only."""

import math


def bessel_i(order: int, x: float) -> float:
    """Modified Bessel function of the first kind by its power series; to rounding for |x| of a few units."""
    term = (x / 2) ** order / math.factorial(order)
    total, k = term, 0
    while abs(term) > 1e-17 * abs(total):
        k += 1
        term *= (x / 2) ** 2 / (k * (k + order))
        total += term
    return total
