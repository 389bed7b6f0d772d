"""Time histories at the interface: sent once, named for ever, played by tests that name them."""

from collections.abc import Iterator

from tests.console_process import ConsoleProcess

CSV = "time_s,force_kn\n0,0\n0.5,1.5\n1,0\n"
TEST = {
    "schema": 1,
    "name": "Gust from a file",
    "blocks": [{"kind": "time_history", "file": "gust.csv", "gain": 2}],
}


def test_a_history_is_kept_and_a_test_may_name_it(console: ConsoleProcess) -> None:
    answer = console.http.post("/histories?name=gust.csv", content=CSV)
    assert answer.status_code == 201, answer.text
    info = answer.json()
    assert (info["file"], info["unit"], info["samples"], info["rate_hz"]) == ("gust.csv", "N", 3, 2)
    assert (info["min"], info["max"], info["duration_s"]) == (0, 1500, 1)
    assert info in console.http.get("/histories").json()
    checked = console.http.post("/tests/check", json={"definition": TEST}).json()
    assert checked["valid"], checked["problems"]
    assert checked["outline"]["peak_force_n"] == 3000
    test = console.http.post("/tests", json={"definition": TEST})
    assert test.status_code == 201, test.text


def test_a_name_stands_for_its_content(console: ConsoleProcess) -> None:
    for _ in range(2):
        answer = console.http.post("/histories?name=once.csv&rate_hz=10", content="f\n1\n2\n")
        assert answer.status_code == 201, answer.text
    answer = console.http.post("/histories?name=once.csv&rate_hz=10", content="f\n1\n3\n")
    assert (answer.status_code, answer.json()["code"]) == (409, "history_exists")


def test_what_is_wrong_is_said_with_its_line(console: ConsoleProcess) -> None:
    answer = console.http.post("/histories?name=bad.csv", content=CSV.replace("1.5", "high"))
    assert (answer.status_code, answer.json()["code"]) == (422, "invalid_history")
    assert "line 3: 'high' is no number" in answer.json()["detail"]
    names = [info["file"] for info in console.http.get("/histories").json()]
    assert "bad.csv" not in names


def test_a_large_history_comes_in_parts(console: ConsoleProcess) -> None:
    def parts() -> Iterator[bytes]:
        for start in range(0, 2_000_000, 20_000):
            yield "".join(f"{i % 1000}\n" for i in range(start, start + 20_000)).encode()

    answer = console.http.post("/histories?name=large.csv&rate_hz=1000", content=parts())
    assert answer.status_code == 201, answer.text
    assert answer.json()["samples"] == 2_000_000
