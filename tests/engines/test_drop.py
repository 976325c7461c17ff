"""The scene that is written beside each mesh, run by its engine for one second."""
import pytest

from bodies import CASES, assert_silent
from drops import ENDINGS, HANGS, SHORTCOMINGS, assert_near_rest, judge, run
from test_load import READERS


def cases():
    for engine in ENDINGS:
        for body, tets in CASES:
            reason = SHORTCOMINGS.get((engine, body, tets))
            mark = pytest.mark.xfail(strict=True, run=(engine, body) not in HANGS, reason=reason) if reason else ()
            yield pytest.param(engine, body, tets, marks=mark)


@pytest.mark.parametrize("engine,body,tets", list(cases()))
def test_a_body_falls_and_comes_to_rest(engine, body, tets, write, prove, capfd):
    written = write(engine, body, tets)
    _, cells = READERS[engine](written)
    capfd.readouterr()
    (start, end, velocities), seconds = run(engine, written)
    assert_silent(capfd)
    numbers = judge(start, end, velocities, cells)
    prove(engine, "drop", written, seconds=seconds, **numbers)
    assert_near_rest(numbers)
    prove(engine, "rest", written)
