"""TetMesh.show: one page that notebooks display, and that needs nothing else."""

from __future__ import annotations

import html
import json
import re
from typing import Any

import pytest
import tetsoup


def data_of(page: str) -> Any:
    found = re.search(r'id="tetsoup-report">(.*?)</script>', page, re.DOTALL)
    assert found
    return json.loads(found.group(1))


def test_a_mesh_is_shown_with_how_it_was_made() -> None:
    soup = tetsoup.sample("torus")
    mesh = tetsoup.tetrahedralize(soup, voxels=32, tets=300)
    page = mesh.show(soup, title="torus")
    data = data_of(page.html)
    assert data["report"]["quality"]["tet_count"] == len(mesh.tets)
    assert data["report"]["soup"]["class"] == "closed"
    assert data["surface"] is not None


def test_the_page_gets_the_numbers_that_its_sentences_are_made_of() -> None:
    mesh = tetsoup.tetrahedralize(tetsoup.sample("torus"), voxels=32, tets=300)
    said = data_of(mesh.show().html)["report"]
    volume = said["pseudo_volume"]
    assert said["grid"]["voxel_size"] ** 3 * volume["inside_voxels"] == pytest.approx(volume["volume"])
    assert {"k", "band", "automatic", "cavity_voxels", "largest_closure", "soup_covered"} <= volume.keys()
    assert {"tet_count", "mean_edge", "thin_tets", "kept_volume"} <= said["lattice"].keys()
    assert {"touching_mended", "parts_dropped"} <= said["lattice"]["topology"].keys()


def test_a_notebook_gets_a_frame_that_asks_for_nothing() -> None:
    mesh = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    page = mesh.show(height=400)
    frame = page._repr_html_()
    assert frame.startswith("<iframe srcdoc=") and 'height="400"' in frame
    inner = html.unescape(frame.split('srcdoc="', 1)[1].split('" title=', 1)[0])
    assert inner == page.html
    assert not re.search(r'(src|href)="(https?:)?//|@import|<link rel="stylesheet"', inner)


def test_a_page_is_saved(tmp_path: Any) -> None:
    mesh = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    path = mesh.show().save(tmp_path / "corner.html")
    assert data_of(path.read_text(encoding="utf-8"))["title"] == "mesh"


def test_another_axis_is_refused() -> None:
    mesh = tetsoup.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    with pytest.raises(tetsoup.InvalidInput, match="up"):
        mesh.show(up="w")  # type: ignore[arg-type]
