"""A point of a frequency response with how it was found."""

from typing import Literal, NamedTuple

from app.analysis.response.point import ResponsePoint

Method = Literal["stepped_sine", "multisine", "sweep"]


class Found(NamedTuple):
    """`noise_std` and `nonlinear_std` are parts of the gain's deviation; None where they are not known apart."""

    method: Method
    point: ResponsePoint
    noise_std: float | None = None
    nonlinear_std: float | None = None
