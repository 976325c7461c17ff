"""Shapes with known answers, and where things are."""

from __future__ import annotations

import os
import pathlib

import numpy as np
import pytest
from hypothesis import settings

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODELS = ROOT.parent / "shared" / "models"

# The same examples every time; HYPOTHESIS_PROFILE=long looks for new ones.
settings.register_profile("steady", max_examples=150, deadline=None, database=None, derandomize=True)
settings.register_profile("long", max_examples=5000, deadline=None, database=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))


def real_package(name):
    """A package of others, or the test is skipped and says why: not installed, or without a library of the system."""
    return pytest.importorskip(name, exc_type=ImportError)


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
