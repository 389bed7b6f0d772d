"""What comes out of a spreadsheet becomes layers, whatever the spreadsheet's country."""

import pytest

from app.definitions.spectrum import read_spectrum

TWO = [(0.0, 5000.0, 100.0, 50), (-10_000.0, 2500.0, 12.5, 1000)]


def _rows(text: str) -> list[tuple[float, float, float, int]]:
    found = read_spectrum(text)
    assert found.problems == ()
    return [(x.mean_n, x.amplitude_n, x.frequency_hz, x.cycles) for x in found.layers]


@pytest.mark.parametrize(
    "text",
    [
        "mean_n\tamplitude_n\tfrequency_hz\tcycles\n0\t5000\t100\t50\n-10000\t2500\t12.5\t1000\n",
        "0\t5000\t100\t50\r\n-10000\t2500\t12.5\t1000\r\n",
        "Cycles,Amplitude [kN],Mean [kN],Frequency (Hz)\n50,5,0,100\n1000,2.5,-10,12.5\n",
        "Zyklen;Amplitude / kN;Mittelwert / kN;Frequenz / Hz\n50;5;0;100\n1000;2,5;-10;12,5\n",
        "n;amplitude;mean;f\n-;kN;kN;Hz\n50;5;0;100\n1000;2,5;-10;12,5",
        'Remark,"Amplitude_N",f,n,mean_kn\nfirst,5e3,100,50,\n"second",2500,1.25e1,1e3,-10\n',
        "\n\nf in kHz,n,amplitude,mean\n0.1,50,5000,0\n\n0.0125,1000,2500,-10000\n,,,\n",
    ],
)
def test_every_way_to_write_a_table_says_the_same(text: str) -> None:
    assert _rows(text) == TWO


def test_a_mean_may_be_left_out() -> None:
    assert _rows("5000,100,50") == [(0.0, 5000.0, 100.0, 50)]


@pytest.mark.parametrize(
    ("text", "path", "line", "says"),
    [
        ("", "", None, "the text is empty"),
        ("mean,ampl,freq,n\n", "", None, "no layers below them"),
        ("1\t2\t3\t4\n1\t2\t\t4\n", "layers[1].frequency_hz", 2, "is missing"),
        ("1\t2\t3\t4\n\n1\t2\tfast\t4\n", "layers[1].frequency_hz", 3, "'fast' is no number"),
        ("1\t2\t3\t4.5", "layers[0].cycles", 1, "must be a whole number"),
        ("1,5\t2\t3\t1,000", "layers[0].cycles", 1, "must be a whole number, without commas"),
        ("0\t60000\t3\t4", "layers[0].amplitude_n", 1, "60,000 N must be at most 50,000 N"),
        ("30000\t30000\t3\t4", "layers[0].amplitude_n", 1, "mean and amplitude reach 60,000 N"),
        ("mean,amplitude [mm],f,n\n1,2,3,4", "", 1, "is in m, must be in N"),
        ("mean,amplitude,n\n1,2,3", "", 1, "no column is headed as frequency_hz"),
        ("mean,mean force,amplitude,f,n\n", "", 1, "two columns are headed as mean_n"),
        ("1,2,3,4,5\n", "", 1, "5 columns without headings"),
        ("1,2,3,4\n" * 1003, "", None, "must be at most 1,000"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(
    text: str, path: str, line: int | None, says: str
) -> None:
    (problem,) = read_spectrum(text).problems
    assert (problem.path, problem.line) == (path, line)
    assert says in problem.expected


def test_lines_that_are_right_come_through_beside_one_that_is_wrong() -> None:
    found = read_spectrum("1,2,3,4\n1,2,x,4\n5,6,7,8\n")
    assert [layer.cycles for layer in found.layers] == [4, 8]
    assert [problem.line for problem in found.problems] == [2]
