"""The shipped rig, without noise or off in one parameter: as a model of it would be."""

from rtcore.rig.parameters import RigParameters, load_rig

_NO_NOISE = {"force_noise_n": 0.0, "velocity_noise_m_s": 0.0}


def quiet(rig: RigParameters) -> RigParameters:
    """Without noise at its sensors, which keep their 16 bits."""
    return rig.model_copy(update={"sensors": rig.sensors.model_copy(update=_NO_NOISE)})


def bypass_off(share: float) -> RigParameters:
    """With that share of the bypass's area."""
    actuator = load_rig().load_actuator
    diameter = actuator.bypass_diameter_m * share**0.5
    off = actuator.model_copy(update={"bypass_diameter_m": diameter})
    return load_rig().model_copy(update={"load_actuator": off})


def valve_off(share: float) -> RigParameters:
    """With that share of the valve's bandwidth."""
    valve = load_rig().servovalve
    off = valve.model_copy(
        update={
            "omega_f_rad_s": valve.omega_f_rad_s * share,
            "spool_gain_rad_s": valve.spool_gain_rad_s * share,
        }
    )
    return load_rig().model_copy(update={"servovalve": off})
