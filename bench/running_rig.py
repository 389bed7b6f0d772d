"""The simulated rig in the middle of a test: what the loop is measured with."""

from app.controller.record import to_record as gains_of
from app.controller.settings import ControllerSettings
from app.definitions.expansion import expand
from app.definitions.reading import parse_definition
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_of
from app.interlocks.table import Interlocks
from rtcore.codes import Opcode
from rtcore.interlocks import Quantity
from rtcore.io.simulated import SimulatedIo
from rtcore.virtual import Virtual

FOR_EVER_NS = 1 << 62
TEST = """
schema: 1
name: Load on a moving actuator, for as long as a benchmark may last
blocks:
  - {kind: harmonic, mean_n: 0, amplitude_n: 2000, frequency_hz: 50, duration_s: 3000}
motion:
  - {kind: harmonic, amplitude_m: 0.002, frequency_hz: 4, duration_s: 3000}
"""


def running_rig(period_ns: int) -> SimulatedIo:
    """A rig that was brought to a running test on the virtual clock; the caller drives it on.

    All detectors as shipped, but the one on missed deadlines: they are what is measured.
    """
    period_s = period_ns * 1e-9
    shipped = default_interlocks().detectors
    table = Interlocks(
        detectors=tuple(d for d in shipped if d.quantity != Quantity.DEADLINES_MISSED)
    )
    test = parse_definition(TEST, "the benchmark's test")
    if isinstance(test, Refusal):
        raise ValueError(test.detail)
    rig = Virtual(gains_of(ControllerSettings()), interlocks_of(table, period_s), period_s=period_s)
    rig.bring_to_ready()
    for reply in (rig.load_program(expand(test)), rig.command(Opcode.START, 1)):
        if reply != 0:
            raise RuntimeError(f"the rig refuses the benchmark's test: {reply.name.lower()}")
    rig.io.warm_up()
    rig.block.fields["app_heartbeat_ns"] = FOR_EVER_NS  # an app that is never silent
    return rig.io
