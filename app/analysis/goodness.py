"""How well a simulation follows a measurement: the paper's confidence parameter."""

import numpy as np
import numpy.typing as npt

Samples = npt.NDArray[np.floating]


def goodness_of_fit(force_n: Samples, simulated_n: Samples) -> float:
    """G of the paper, eq. (4), in %: 100 where simulation and measurement agree at every sample.

    `force_n` is the measured force and `simulated_n` the simulated one, both (n_samples,); the
    error is normalised by the peak of the measured force. It is too forgiving to stand alone: a
    simulation that ignores the motion still scores 95. NaN where the measured force is zero
    throughout. Raises ValueError where the lengths differ or nothing is given.
    """
    if len(force_n) != len(simulated_n) or len(force_n) == 0:
        raise ValueError(f"{len(force_n)} samples against {len(simulated_n)}")
    measured = np.asarray(force_n, np.float64)
    peak_n = np.max(np.abs(measured))
    if not peak_n > 0:
        return float("nan")
    error = (measured - np.asarray(simulated_n, np.float64)) / peak_n
    return float(100 * (1 - np.sqrt(np.mean(error**2))))
