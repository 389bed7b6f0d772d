"""The shared block's layout: one declaration, from which the offsets and the layout hash derive."""

import hashlib

import numpy as np

from rtcore.channels import TELEMETRY
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.compiled import kernel, offset_of
from rtcore.control.gains import GAINS
from rtcore.interlocks import (
    INTERLOCKS,
    MAX_DETECTORS,
    Action,
    Comparison,
    Form,
    Quantity,
    SensorFault,
)
from rtcore.io import FAULT_SLOTS
from rtcore.modes import Mode
from rtcore.program.generator import GENERATOR
from rtcore.program.segments import PROGRAM, Branch, Segment
from rtcore.rig.model import MODEL

MAGIC = 0x4749524543524F46  # "FORCERIG", little-endian
COMMAND_SLOTS = 64
EVENT_SLOTS = 4096
HISTOGRAM_BINS = 1000
HISTOGRAM_BIN_S = 1e-6
CONDITIONS_BYTES = 8192

COMMAND = np.dtype(
    [
        ("sequence", "i8"),
        ("expires_ns", "i8"),  # monotonic clock; refused afterwards
        ("lease", "i8"),  # epoch of the command lease
        ("argument", "i8"),
        ("value", "f8"),
        ("opcode", "i8"),
    ],
    align=True,
)
ACKNOWLEDGEMENT = np.dtype([("sequence", "i8"), ("tick", "i8"), ("reply", "i8")], align=True)
EVENT = np.dtype(
    [
        ("sequence", "i8"),
        ("tick", "i8"),
        ("kind", "i8"),  # EventKind
        ("code", "i8"),  # mode, detector, opcode or block
        ("value", "f8"),  # what was seen
        ("limit", "f8"),  # what was allowed
    ],
    align=True,
)

BLOCK = np.dtype(
    [
        ("magic", "i8"),
        ("layout_hash", "i8"),
        ("telemetry_slots", "i8"),  # a power of two
        ("period_ns", "i8"),
        ("loop_pid", "i8"),
        ("loop_started_ns", "i8"),  # monotonic clock; names this life of the loop
        # Two processes write these: each has a cache line of its own.
        ("loop_heartbeat_ns", "i8"),
        ("_pad0", "i8", (8,)),
        ("app_heartbeat_ns", "i8"),
        ("_pad1", "i8", (8,)),
        ("stop_asked_ns", "i8"),  # any change of it is a Stop
        ("recorded", "i8"),  # telemetry records that are safe on a disk
        ("commands_posted", "i8"),
        ("_pad2", "i8", (8,)),
        ("commands_taken", "i8"),
        ("_pad3", "i8", (8,)),
        ("events_published", "i8"),
        ("telemetry_published", "i8"),
        ("snapshot_sequence", "i8"),  # odd while the snapshot is being written
        ("snapshot", TELEMETRY),
        (
            "program_ticks",
            "i8",
        ),  # of this run in which its program went on: not held, not being stopped
        ("playing_sequence", "i8"),  # odd while the two after it are being written
        ("playing_force", GENERATOR),
        ("playing_motion", GENERATOR),
        ("first_out", "i8"),  # detector that tripped first since the last reset, -1 for none
        ("first_out_tick", "i8"),
        ("lease", "i8"),  # the epoch that commands must bear
        ("detector_values", "f8", (MAX_DETECTORS,)),  # as judged in the latest tick
        ("detector_ticks", "i8", (MAX_DETECTORS,)),  # for how long each has been violated
        ("injected", "f8", (FAULT_SLOTS,)),  # amount of each fault of a simulated rig, 0: none
        ("twin_force_n", "f8"),
        ("active_gains", "i8"),
        ("active_interlocks", "i8"),
        ("active_program", "i8"),
        ("active_model", "i8"),
        ("late_ticks", "i8"),  # ticks that ended after the next deadline
        ("wakeup_histogram", "i8", (HISTOGRAM_BINS,)),
        ("tick_time_histogram", "i8", (HISTOGRAM_BINS,)),
        ("commands", COMMAND, (COMMAND_SLOTS,)),
        ("acknowledgements", ACKNOWLEDGEMENT, (COMMAND_SLOTS,)),
        ("gains", GAINS, (2,)),
        ("interlocks", INTERLOCKS, (2,)),
        ("programs", PROGRAM, (2,)),
        ("models", MODEL, (2,)),
        ("events", EVENT, (EVENT_SLOTS,)),
        ("conditions", f"S{CONDITIONS_BYTES}"),  # JSON: which real-time conditions were had
    ],
    align=True,
)


_CODES = (
    Opcode,
    Reply,
    EventKind,
    Mode,
    Segment,
    Branch,
    Quantity,
    Form,
    Comparison,
    Action,
    SensorFault,
)


def _layout_hash() -> int:
    described = repr(
        (
            BLOCK.descr,
            TELEMETRY.descr,
            [[(m.name, m.value) for m in e] for e in _CODES],
        )
    )
    return int.from_bytes(hashlib.sha256(described.encode()).digest()[:7], "little")


LAYOUT_HASH = _layout_hash()
RING_OFFSET = -(-BLOCK.itemsize // 4096) * 4096


_MODELS = offset_of(BLOCK, "models")
_MODEL_BYTES = MODEL.itemsize


@kernel
def model_address(block_address: int, bank: int) -> int:
    """Where one of the two models is."""
    return block_address + _MODELS + bank * _MODEL_BYTES


def block_bytes(telemetry_slots: int) -> int:
    """Size of a block whose telemetry ring has this many records."""
    return RING_OFFSET + telemetry_slots * TELEMETRY.itemsize
