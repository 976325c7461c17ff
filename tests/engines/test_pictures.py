"""Draws what docs/ENGINES.md shows; only with TETSOUP_ENGINE_PICTURES=folder."""
import os
import pathlib

import pytest

from drops import ENDINGS, run
from test_load import READERS

FOLDER = os.environ.get("TETSOUP_ENGINE_PICTURES")


@pytest.mark.skipif(not FOLDER, reason="pictures are drawn for the docs only")
@pytest.mark.parametrize("engine", ENDINGS)
def test_draw(engine, write):
    from pictures import draw

    written = write(engine, "bunny", 500)
    (start, end, _), _ = run(engine, written)
    pathlib.Path(FOLDER).mkdir(parents=True, exist_ok=True)
    path = pathlib.Path(FOLDER) / f"{engine}.png"
    draw(path, start, end, READERS[engine](written)[1])
    assert path.stat().st_size < 60_000
