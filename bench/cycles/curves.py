"""Errors of pictures, and how many samples or how much time an error takes."""

import math

RELATIVE_FLOOR = 0.01


def squared_error(planes, reference):
    """Mean over pixels and channels."""
    total = sum((a - b)**2 for plane, other in zip(planes, reference) for a, b in zip(plane, other))
    return total / sum(map(len, reference))


def relative_squared_error(planes, reference):
    """Mean of the square over that of the reference and 0.01, as `grove render --compare` has it as relMSE."""
    total = sum((a - b)**2 / (b * b + RELATIVE_FLOOR) for plane, other in zip(planes, reference) for a, b in zip(plane, other))
    return total / sum(map(len, reference))


def mean(planes):
    return sum(map(sum, planes)) / sum(map(len, planes))


def samples_for(error, curve):
    """Samples that take a renderer to this error, by lines between its (samples, error) in logarithms; the last line goes on beyond both ends."""
    points = [(math.log(n), math.log(e)) for n, e in sorted(curve.items())]
    wanted = math.log(error)
    lines = list(zip(points, points[1:]))
    (x0, y0), (x1, y1) = next((line for line in lines if line[1][1] <= wanted), lines[-1])
    if y1 >= y0:
        raise ValueError("more samples do not lower the error")
    return math.exp(x0 + (wanted - y0) * (x1 - x0) / (y1 - y0))


def seconds_a_sample(seconds):
    """What one more sample of all pixels takes, from seconds by number of samples: without what a render takes whatever its samples."""
    least, most = min(seconds), max(seconds)
    return (seconds[most] - seconds[least]) / (most - least)
