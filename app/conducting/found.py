"""A point of a frequency response with how it was found."""

from typing import Literal, NamedTuple

from app.analysis.response.point import ResponsePoint

Method = Literal["stepped_sine", "multisine", "sweep"]


class Found(NamedTuple):
    """`noise_std` and `nonlinear_std` are parts of the gain's deviation; None where they are not known apart.

    `amplitude_m` is that of the motion where it is along the motion that it was found: `amplitude_n` is 0 there,
    `mean_n` the force that was commanded meanwhile, and `block` counts motions.
    """

    method: Method
    point: ResponsePoint
    noise_std: float | None = None
    nonlinear_std: float | None = None
    amplitude_m: float | None = None
