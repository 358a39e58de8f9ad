"""Tests over many rows at once: each row's own limit lets through what all rows together do not.

Tail probabilities are continued fractions and series of the incomplete gamma and beta functions (no package needed).
`python3 tools/pooled.py` checks them against tabulated values.
"""
import math
import statistics


def chi2_tail(x, df):
    """Chance of a chi-square beyond x."""
    a, x = df / 2, x / 2
    if x <= 0:
        return 1.0
    front = math.exp(-x + a * math.log(x) - math.lgamma(a))
    if x < a + 1:
        term = total = 1 / a
        n = a
        while abs(term) > 1e-16 * abs(total):
            n += 1
            term *= x / n
            total += term
        return 1 - front * total
    b, c, d = x + 1 - a, 1e300, 1 / (x + 1 - a)
    h = d
    for i in range(1, 10000):
        an = -i * (i - a)
        b += 2
        d = 1 / (an * d + b)
        c = b + an / c
        h *= d * c
        if abs(d * c - 1) < 1e-15:
            break
    return front * h


def beta_share(x, a, b):
    """The regularised incomplete beta function."""
    if x <= 0 or x >= 1:
        return float(x >= 1)
    if x > (a + 1) / (a + b + 2):
        return 1 - beta_share(1 - x, b, a)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)) / a
    c, d = 1.0, 1 / (1 - (a + b) * x / (a + 1))
    h = d
    for m in range(1, 10000):
        for top in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                    -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1 / (1 + top * d)
            c = 1 + top / c
            h *= d * c
        if abs(d * c - 1) < 1e-15:
            break
    return front * h


def student_tails(t, df):
    """Chance of a |t| beyond."""
    return beta_share(df / (df + t * t), df / 2, 0.5)


def f_below(f, df1, df2):
    """Chance of a ratio of variances below f."""
    return beta_share(df1 * f / (df1 * f + df2), df1 / 2, df2 / 2)


def fisher(ps):
    """One p-value for independent ones: -2 sum ln p is a chi-square of twice their number."""
    return chi2_tail(-2 * sum(map(math.log, ps)), 2 * len(ps))


def stouffer(signed):
    """Two-sided p-value and z of all signed two-sided p-values (p, sign) in one direction."""
    normal = statistics.NormalDist()
    z = sum(sign * -normal.inv_cdf(p / 2) for p, sign in signed) / math.sqrt(len(signed))
    return 2 * normal.cdf(-abs(z)), z


def check():
    """Tables: the 5 % points of each law, and Fisher's rule for p-values that say nothing."""
    for found, wanted in ((chi2_tail(18.307038, 10), .05), (chi2_tail(3.841459, 1), .05), (chi2_tail(124.342113, 100), .05),
                          (student_tails(2.570582, 5), .05), (student_tails(12.706205, 1), .05), (f_below(1 / 4.102821, 10, 2), None),
                          (1 - f_below(4.102821, 2, 10), .05), (fisher([.5]), .5)):
        assert wanted is None or abs(found - wanted) < 1e-6, (found, wanted)
    assert abs(f_below(1 / 4.102821, 10, 2) - (1 - f_below(4.102821, 2, 10))) < 1e-12


if __name__ == "__main__":
    check()
    print("pooled: laws as tabulated")
