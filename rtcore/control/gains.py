"""The settings of the control law, in the paper's names (section 6, figures 10 and 11)."""

import numpy as np

GAINS = np.dtype(
    [
        ("k_p", "f8"),  # 1/N, valve command per newton
        ("k_i", "f8"),  # 1/(N s)
        ("k_d", "f8"),  # s/N, on the filtered derivative of the force error
        ("omega_d_rad_s", "f8"),  # corner of the derivative filter
        ("k_ff", "f8"),  # s/N, on the derivative of the force setpoint
        ("valve_limit", "f8"),  # saturation of the valve command, 0…1
        ("valve_slew_per_s", "f8"),  # slew limit of the valve command, inf for none
        ("ff_v", "f8"),  # s/m, valve command per filtered velocity
        ("ff_a", "f8"),  # s²/m, valve command per derivative of the filtered velocity
        ("lead_zero_rad_s", "f8"),
        ("lead_pole_rad_s", "f8"),
        ("low_pass_rad_s", "f8"),
        ("low_pass_damping", "f8"),  # second order only
        ("notch_damping", "f8"),  # ζ_d, its width; the notch is centred on the load frequency
        ("fade_s", "f8"),  # how long a branch takes to join or leave
        ("low_pass_order", "i8"),  # 1 or 2
        ("compensate", "i8"),  # 0: the branch is never used
    ],
    align=True,
)
