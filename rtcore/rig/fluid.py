"""The hydraulic fluid: liquid with free air, density and bulk modulus from one function."""

from rtcore.compiled import Record, inlined, kernel
from rtcore.rig.plant import FLUID_POINTS, FLUID_STEP_PA

LOWEST_PRESSURE_PA = 1e3  # below it the oil is vapour, which this model does not follow


@kernel
def specific_volume_law(plant: Record, pressure_pa: float) -> tuple[float, float]:
    """(v, dv/dp): volume per reference volume, and its slope (1/Pa), by the closed form.

    v(p) = (1-α)(1 + m(p-p_ref)/β0)^(-1/m) + α(p_ref/p)^(1/n).
    """
    p = max(pressure_pa, LOWEST_PRESSURE_PA)
    tangent = plant.beta0_pa + plant.m_beta * (p - plant.reference_pa)
    liquid = (1.0 - plant.alpha) * (tangent / plant.beta0_pa) ** (-1.0 / plant.m_beta)
    air = plant.alpha * (plant.reference_pa / p) ** (1.0 / plant.n_air)
    return liquid + air, -liquid / tangent - air / (plant.n_air * p)


def tabulate_fluid(plant: Record) -> None:
    """Fill the plant's fluid table: two powers a chamber and stage would be half of the tick's time."""
    for i in range(FLUID_POINTS):
        v, slope = specific_volume_law(plant, i * FLUID_STEP_PA)
        plant["fluid_table"][i] = v, slope * FLUID_STEP_PA


@inlined
def specific_volume(plant: Record, pressure_pa: float) -> tuple[float, float]:
    """(v, dv/dp) as `specific_volume_law`, by cubic Hermite interpolation of its table.

    Within 1e-8 of the law above 0.1 MPa (1e-12 above 1 MPa). The slope is that of the interpolant itself,
    so β = -v/(dv/dp) closes mass exactly here too.
    """
    place = pressure_pa * (1.0 / FLUID_STEP_PA)
    if not 1.0 <= place < FLUID_POINTS - 1:
        return specific_volume_law(plant, pressure_pa)
    i = int(place)
    t = place - i
    a, da = plant.fluid_table[i, 0], plant.fluid_table[i, 1]
    b, db = plant.fluid_table[i + 1, 0], plant.fluid_table[i + 1, 1]
    c2 = 3.0 * (b - a) - 2.0 * da - db
    c3 = da + db - 2.0 * (b - a)
    v = a + t * (da + t * (c2 + t * c3))
    return v, (da + t * (2.0 * c2 + t * 3.0 * c3)) * (1.0 / FLUID_STEP_PA)
