"""The detectors that the rig starts with, in the order in which the loop evaluates them."""

from app.interlocks.table import Detector, Interlocks
from rtcore.interlocks import Action, Comparison, Quantity
from rtcore.modes import Mode

PRESSURISED = (Mode.PRESSURISING, Mode.READY, Mode.RUNNING, Mode.HOLDING, Mode.STOPPING)
LOADABLE = (Mode.READY, Mode.RUNNING, Mode.HOLDING)
RISING = (Mode.PRESSURISING,)
IN_A_TEST = (Mode.RUNNING, Mode.HOLDING)

_ABOVE, _BELOW, _MAGNITUDE = Comparison.ABOVE, Comparison.BELOW, Comparison.MAGNITUDE_ABOVE
_STOP, _SHUTDOWN = Action.STOP, Action.SHUTDOWN

# name, quantity, comparison, threshold, persistence_s, action, armed
_ROWS = (
    ("force", Quantity.FORCE_N, _MAGNITUDE, 55e3, 0.0, _SHUTDOWN, PRESSURISED),
    ("force_error", Quantity.FORCE_ERROR_N, _MAGNITUDE, 15e3, 0.05, _STOP, IN_A_TEST),
    ("displacement", Quantity.DISPLACEMENT_M, _MAGNITUDE, 0.032, 0.0, _STOP, PRESSURISED),
    ("velocity", Quantity.VELOCITY_M_S, _MAGNITUDE, 0.4, 0.01, _STOP, PRESSURISED),
    ("load_cell", Quantity.LOAD_CELL, _ABOVE, 0.5, 0.0, _SHUTDOWN, tuple(Mode)),
    ("lvt", Quantity.LVT, _ABOVE, 0.5, 0.0, _SHUTDOWN, tuple(Mode)),
    ("lvdt", Quantity.LVDT, _ABOVE, 0.5, 0.0, _SHUTDOWN, tuple(Mode)),
    ("pressure_sensor", Quantity.PRESSURE_SENSOR, _ABOVE, 0.5, 0.0, _SHUTDOWN, tuple(Mode)),
    ("supply_pressure", Quantity.SUPPLY_PRESSURE_PA, _BELOW, 15e6, 0.05, _STOP, LOADABLE),
    ("slow_pressure", Quantity.SUPPLY_PRESSURE_PA, _BELOW, 19e6, 15.0, _SHUTDOWN, RISING),
    ("app_silence", Quantity.APP_SILENCE_S, _ABOVE, 0.5, 0.0, _STOP, PRESSURISED),
    ("deadlines_missed", Quantity.DEADLINES_MISSED, _ABOVE, 40.0, 0.0, _STOP, PRESSURISED),
)


def default_interlocks() -> Interlocks:
    """The table as shipped."""
    return Interlocks(
        detectors=tuple(
            Detector(
                name=name,
                quantity=quantity,
                comparison=comparison,
                threshold=threshold,
                persistence_s=persistence_s,
                action=action,
                armed=armed,
            )
            for name, quantity, comparison, threshold, persistence_s, action, armed in _ROWS
        )
    )
