"""The command line of the loop process."""

import pytest

from rtcore.__main__ import parse

BLOCK = ["--block", "/dev/shm/forcerig"]


def test_by_default_it_runs_the_shipped_rig_at_4_khz() -> None:
    options = parse(BLOCK)
    assert (options.period_us, options.margin_us, options.priority) == (250, 60, 80)
    assert options.rig is options.cpu is options.log is None


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "--block"),
        ([*BLOCK, "--period-us", "10"], "--period-us must be 50 to 1000000"),
        ([*BLOCK, "--margin-us", "250"], "--margin-us must be at least 0 and less than the period"),
        ([*BLOCK, "--margin-us", "-1"], "--margin-us must be at least 0"),
        ([*BLOCK, "--priority", "0"], "--priority must be 1 to 99"),
        ([*BLOCK, "--priority", "100"], "--priority must be 1 to 99"),
        ([*BLOCK, "--seed", "one"], "--seed: invalid int value"),
    ],
)
def test_what_is_wrong_is_said_with_exit_code_2(
    capsys: pytest.CaptureFixture[str], arguments: list[str], words: str
) -> None:
    with pytest.raises(SystemExit) as ended:
        parse(arguments)
    assert ended.value.code == 2
    assert words in capsys.readouterr().err.splitlines()[-1]
