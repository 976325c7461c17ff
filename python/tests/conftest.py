"""Shapes with known answers, and where things are."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODELS = ROOT.parent / "shared" / "models"


@pytest.fixture
def cube():
    """The unit cube: 8 vertices, 12 triangles, closed."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return corners, np.array([[q[0], q[i], q[i + 1]] for q in quads for i in (1, 2)])


@pytest.fixture
def bunny():
    path = MODELS / "bunny-69k.ply"
    if not path.exists():
        pytest.skip(f"no model {path.name} here")
    return path
