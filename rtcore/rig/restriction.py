"""Flow through restrictions: laminar near zero pressure drop, turbulent far from it."""

from rtcore.compiled import Four, inlined
from rtcore.lanes import divide4, sqrt4


@inlined
def flows4(
    drop_a: float,
    drop_b: float,
    drop_c: float,
    drop_d: float,
    r_a: float,
    r_b: float,
    r_c: float,
    r_d: float,
    k_a: float,
    k_b: float,
    k_c: float,
    k_d: float,
) -> Four:
    """Flows (m³/s) of four restrictions at which drop = r Q + k Q|Q| (Pa), each the closed-form root

    Q = 2 drop/(r + √(r² + 4 k |drop|)), whose slope at zero is 1/r where that of a plain root is infinite.
    """
    root_a, root_b, root_c, root_d = sqrt4(
        r_a * r_a + 4.0 * k_a * abs(drop_a),
        r_b * r_b + 4.0 * k_b * abs(drop_b),
        r_c * r_c + 4.0 * k_c * abs(drop_c),
        r_d * r_d + 4.0 * k_d * abs(drop_d),
    )
    return divide4(
        2.0 * drop_a, 2.0 * drop_b, 2.0 * drop_c, 2.0 * drop_d,
        r_a + root_a, r_b + root_b, r_c + root_c, r_d + root_d,
    )  # fmt: skip
