"""Bounds on a probability from a count: Clopper and Pearson (1934), which keep their 95 % for every probability."""

import math


def incomplete_beta(a, b, x):
    """The regularised one, by its continued fraction (Lentz's method)."""
    if x <= 0.0 or x >= 1.0:
        return 0.0 if x <= 0.0 else 1.0
    if x > (a + 1) / (a + b + 2):
        return 1.0 - incomplete_beta(b, a, 1.0 - x)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)) / a
    tiny = 1e-300
    c, d = 1.0, 1.0 / (1.0 - (a + b) * x / (a + 1))
    fraction = d
    for m in range(1, 10000):
        even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        for term in (even, odd):
            d = 1.0 / ((1.0 + term * d) or tiny)
            c = (1.0 + term / c) or tiny
            fraction *= c * d
        if abs(c * d - 1.0) < 1e-13:
            return front * fraction
    raise ArithmeticError(f"no convergence for {a}, {b}, {x}")


def quantile(a, b, share):
    low, high = 0.0, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if incomplete_beta(a, b, middle) < share else (low, middle)
    return (low + high) / 2


def bounds(count, trials, confidence=0.95):
    tail = (1 - confidence) / 2
    low = 0.0 if count == 0 else quantile(count, trials - count + 1, tail)
    high = 1.0 if count == trials else quantile(count + 1, trials - count, 1 - tail)
    return low, high
