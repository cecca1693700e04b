#!/usr/bin/python3
"""Adapter for statsmodels 0.13 (the package python3-statsmodels).

It computes general regression neural networks on given samples. Such a network is KernelReg, local constant, with a Gaussian
kernel of bandwidth sigma in each input.
"""
import math

import numpy
from statsmodels.nonparametric.kernel_regression import KernelReg

from trammel_adapter import Cannot, main


def solve(case):
    options = case.options
    for key in options:
        if case.kind != "grnn" or key not in ("samples", "queries", "sigma", "spread", "scaling"):
            raise Cannot(f"{case.kind} with the option {key} is not supported")
    inputs, outputs, queries = (numpy.array(rows, dtype=float) for rows in
                                (options["samples"]["inputs"], options["samples"]["outputs"], options["queries"]))
    sigma = options["sigma"] if "sigma" in options else options["spread"] / math.sqrt(2) / 0.8326
    if not 1e-3 < sigma < 1e3:
        raise Cannot("sigma outside 1e-3 ... 1e3, where exp(-D^2 / 2 sigma^2) may underflow, is not supported")
    scaling = options.get("scaling", "none")
    if scaling != "none":
        scale = inputs.std(axis=0) if scaling == "deviation" else numpy.ptp(inputs, axis=0)
        scale[scale == 0] = 1
        inputs, queries = inputs / scale, queries / scale
    with numpy.errstate(all="ignore"):
        found = [KernelReg(column, inputs, "c" * inputs.shape[1], reg_type="lc", bw=[sigma] * inputs.shape[1]).fit(queries)[0]
                 for column in outputs.T]
    if not numpy.isfinite(found).all():
        raise Cannot("a query is so far from all samples that every weight underflows")
    return {f"prediction:{k + 1}": ("1", list(values)) for k, values in enumerate(found) if f"prediction:{k + 1}" in case.asked}


if __name__ == "__main__":
    main(solve, name="statsmodels", version="0.13.5")
