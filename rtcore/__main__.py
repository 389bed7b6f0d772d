"""The loop process: arguments, lock, real-time conditions, signals. `python -m rtcore --help`."""

import argparse
import logging
import os
import signal
import sys
from pathlib import Path

import yaml

from rtcore.clock import now_ns, wait_until
from rtcore.io.simulated import SimulatedIo
from rtcore.loop import account, keep_time, warm_up
from rtcore.memory.segment import Block, BlockError, create_block, lock_single_loop
from rtcore.realtime import PRIORITY, as_json, take_all
from rtcore.rig.parameters import RigParameters, load_rig

log = logging.getLogger("rtcore")


def parse(arguments: list[str] | None = None) -> argparse.Namespace:
    """The command line. What is wrong with it ends the process with one line and exit code 2."""
    parser = argparse.ArgumentParser(prog="python -m rtcore", description="The real-time loop.")
    parser.add_argument("--block", type=Path, required=True, help="shared block, in /dev/shm")
    parser.add_argument("--rig", type=Path, help="YAML or JSON; default: the shipped rig")
    parser.add_argument("--seed", type=int, default=0, help="seed of the sensors' noise")
    parser.add_argument("--period-us", type=int, default=250, help="period of the loop")
    parser.add_argument("--margin-us", type=int, default=60, help="watch the clock this long")
    parser.add_argument("--cpu", type=int, help="processor to run on; default: the last one")
    parser.add_argument("--priority", type=int, default=PRIORITY, help="of SCHED_FIFO, 1 to 99")
    parser.add_argument("--log", type=Path, help="append messages to this file, not to stderr")
    options = parser.parse_args(arguments)
    if not 50 <= options.period_us <= 1_000_000:
        parser.error("--period-us must be 50 to 1000000")
    if not 0 <= options.margin_us < options.period_us:
        # Without sleep the kernel takes the processor away for 50 ms of each second.
        parser.error("--margin-us must be at least 0 and less than the period")
    if not 1 <= options.priority <= 99:
        parser.error("--priority must be 1 to 99")
    return options


def run(options: argparse.Namespace) -> None:
    """Run the loop until SIGTERM or SIGINT. Raises `BlockError`, `OSError` or `ValueError`."""
    running = [True]
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: running.clear())
    with lock_single_loop(options.block):
        rig = read_rig(options.rig)
        period_ns = options.period_us * 1000
        # Whoever attaches is to see a living loop: the block takes its place when all is warm.
        staged = options.block.with_name(f".{options.block.name}.staged")
        block = create_block(staged, period_ns)
        try:
            io = SimulatedIo(rig, options.seed, block)
            io.warm_up()
            warm_up()
            take_conditions(block, options)
            log.info("running: period %d µs, block %s", options.period_us, options.block.name)
            started_ns = sign(block)
            staged.replace(options.block)
        finally:
            staged.unlink(missing_ok=True)
        try:
            keep_time(
                running,
                wait_until,
                io.cycle,
                account,
                block_address=block.address,
                start_ns=started_ns,
                period_ns=period_ns,
                margin_ns=options.margin_us * 1000,
            )
        finally:
            io.close()
        log.info("ended after %d ticks", block.fields["telemetry_published"])


def read_rig(path: Path | None) -> RigParameters:
    """The rig of a file, or the shipped one. Raises `OSError`, or `ValueError` that names the file."""
    try:
        return load_rig(path)
    except (ValueError, yaml.YAMLError) as error:
        raise ValueError(f"{path}: {error}") from None


def take_conditions(block: Block, options: argparse.Namespace) -> None:
    """Take the real-time conditions, and tell what was had in the log and the block."""
    conditions = take_all(options.cpu, options.priority)
    for name, had, reason in conditions:
        log.log(logging.INFO if had else logging.WARNING, "%s: %s", name, reason)
    block.fields["conditions"] = as_json(conditions)


def sign(block: Block) -> int:
    """Sign the block as this life of the loop. Returns when it began, in ns."""
    started_ns = now_ns()
    block.fields["loop_pid"] = os.getpid()
    block.fields["loop_started_ns"] = block.fields["loop_heartbeat_ns"] = started_ns
    return started_ns


def main() -> int:
    """Exit code: 0 after a signal, 2 where the loop could not start."""
    options = parse()
    logging.basicConfig(
        filename=options.log, level=logging.INFO, format="%(asctime)s %(levelname)s %(message)s"
    )
    try:
        run(options)
    except (BlockError, OSError, ValueError) as error:
        print("rtcore:", " ".join(str(error).split()), file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
