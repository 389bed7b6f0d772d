"""The simulated rig behind the I/O boundary, and its binding to the tick."""

from typing import Any

import numpy as np

from rtcore.clock import wait_until
from rtcore.compiled import address_of, carray, kernel, pointer
from rtcore.core import CORE, make_core
from rtcore.memory.layout import BLOCK, model_address
from rtcore.memory.segment import Block, private_block
from rtcore.rig.failing import lateness_ns, take_faults
from rtcore.rig.model import adopt_model
from rtcore.rig.parameters import RigParameters
from rtcore.rig.twin import make_twin, move_twin
from rtcore.rig.world import WORLD, make_world, read_world, write_world
from rtcore.tick import tick

READY_SHARE = 19.0 / 21.0  # of high pressure: 190 of 210 bar
ROUGHNESS = (12.0 / np.pi) ** 0.5  # mean magnitude of white noise's second difference, in sigmas
LOW_SHARE = 5.0 / 7.0  # of low pressure: enough to go on to high


@kernel
def cycle(
    block_address: int,
    core_address: int,
    world_address: int,
    twin_address: int,
    now_ns: int,
    wakeup_latency_ns: int,
    tick_time_ns: int,
    missed: int,
) -> None:
    """read → tick → write."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    core = carray(pointer(core_address), 1, CORE)[0]
    world = carray(pointer(world_address), 1, WORLD)[0]
    period_s = core.settings.period_s
    take_faults(world, core.injected)
    read_world(world, core.inputs, period_s)
    if twin_address != 0:
        twin = carray(pointer(twin_address), 1, WORLD)[0]
        if core.model_due != 0:
            adopt_model(twin_address, model_address(block_address, block.active_model))
            core.model_due = 0
        force_n, spool = move_twin(twin, core.outputs, period_s)
        core.observed.twin_force_n = block.twin_force_n = force_n
        core.observed.twin_spool = spool
    tick(core, block, block_address, now_ns, wakeup_latency_ns, tick_time_ns, missed)
    write_world(world, core.outputs, period_s)


@kernel
def cycle_on_the_clock(
    block_address: int,
    core_address: int,
    world_address: int,
    twin_address: int,
    now_ns: int,
    wakeup_latency_ns: int,
    tick_time_ns: int,
    missed: int,
) -> None:
    """A cycle that keeps the processor afterwards where the rig is late by fault."""
    addresses = block_address, core_address, world_address, twin_address
    cycle(*addresses, now_ns, wakeup_latency_ns, tick_time_ns, missed)
    kept_ns = lateness_ns(carray(pointer(world_address), 1, WORLD)[0])
    if kept_ns > 0:
        wait_until(now_ns + kept_ns, kept_ns)


class SimulatedIo:
    """Loop and simulated rig, bound to one block. `core` and `world` are theirs alone.

    With `twin` a second rig, without noise and without faults, runs beside it on the same outputs: of the
    same parameters until a model is adopted.
    """

    def __init__(
        self,
        rig: RigParameters,
        seed: int,
        block: Block,
        settings: dict[str, float] | None = None,
        *,
        twin: bool = True,
    ) -> None:
        inside = 1.0 - 1.5 / 2.0 ** (
            rig.sensors.bits - 1
        )  # the last step of a converter is its end
        ranges = {
            "force_range_n": inside * rig.sensors.force_range_n,
            "velocity_range_m_s": inside * rig.sensors.velocity_range_m_s,
            "displacement_range_m": inside * rig.sensors.displacement_range_m,
            "pressure_range_pa": inside * rig.sensors.pressure_range_pa,
            "force_noise_n": ROUGHNESS * rig.sensors.force_noise_n,
            "velocity_noise_m_s": ROUGHNESS * rig.sensors.velocity_noise_m_s,
            "area_m2": rig.load_actuator.area_m2,
            "displacement_limit_m": rig.unit.stroke_m,
            "ready_pa": READY_SHARE * rig.supply.high_pa,
            "low_reached_pa": LOW_SHARE * rig.supply.low_pa,
            "simulated": 1,
        }
        self.block = block
        self.cores = make_core(block.period_s, ranges | (settings or {}))
        self.worlds = make_world(rig, seed)
        self.core["observed"]["has_twin"] = twin
        self._twins = make_twin(rig)
        self.addresses = (
            block.address,
            address_of(self.cores),
            address_of(self.worlds),
            address_of(self._twins) if twin else 0,
        )

    @property
    def core(self) -> Any:
        return self.cores[0]

    @property
    def world(self) -> Any:
        return self.worlds[0]

    def warm_up(self) -> None:
        """Compile the tick on copies of everything, then freeze it: no tick may ever compile."""
        spare = private_block(int(self.block.fields["period_ns"]), seconds=0.01)
        cores, worlds, twins = (np.copy(part) for part in (self.cores, self.worlds, self._twins))
        copies = address_of(cores), address_of(worlds), address_of(twins)
        compiled: tuple[Any, ...] = (cycle, cycle_on_the_clock)
        for kernel_of_tick in compiled:
            kernel_of_tick(spare.address, *copies, 0, 0, 0, 0)
            kernel_of_tick.disable_compile()

    def cycle(self, now_ns: int, wakeup_latency_ns: int, tick_time_ns: int, missed: int) -> None:
        """One tick."""
        cycle_on_the_clock(*self.addresses, now_ns, wakeup_latency_ns, tick_time_ns, missed)

    def close(self) -> None:
        """Nothing to leave safe: a simulated rig ends with its process."""
