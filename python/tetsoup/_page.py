"""A report that people look at: one page of HTML, in a notebook or in a file."""

from __future__ import annotations

import html
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any

import numpy as np

from tetsoup import _core
from tetsoup._soup_input import as_soup

if TYPE_CHECKING:
    from tetsoup._mesh import Report, TetMesh


class Page:
    """A page that shows a mesh in 3D with a plane that cuts it, its angles, and how it was made.

    Notebooks show it by themselves; it asks for nothing from the network, and IPython need not be installed.
    Made by `TetMesh.show`.

    Example:
        >>> mesh.show().save("bunny.html")
        PosixPath('bunny.html')
    """

    def __init__(self, text: str, height: int) -> None:
        self.html = text
        """All of the page."""
        self.height = height
        """Pixels in a notebook."""

    def _repr_html_(self) -> str:
        # A frame of its own, so that neither the page's styles nor its scripts meet those of the notebook.
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" title="Report of a tet mesh" width="100%" '
            f'height="{self.height}" style="border: 0" sandbox="allow-scripts"></iframe>'
        )

    def save(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Writes the page, which any browser opens, and returns its path."""
        target = pathlib.Path(path)
        target.write_text(self.html, encoding="utf-8")
        return target

    def __repr__(self) -> str:
        return f"<tetsoup.Page: {len(self.html):,} characters>"


def _as_json(report: Report | None) -> str:
    """What the page reads of a report, by the names of `tetsoup mesh --json`."""
    if report is None:
        return "{}"
    soup = report.soup.as_dict()
    low, high = soup.pop("box")
    soup["class"] = soup.pop("kind")
    soup["box"] = {"lo": list(low), "hi": list(high)}
    volume = report.pseudo_volume.as_dict()
    found = {
        "soup": soup,
        "grid": {"voxel_size": volume["band"] / volume["band_voxels"]},
        "pseudo_volume": volume,
        "lattice": report.lattice.as_dict(),
        "options": report.options,
        "seconds": report.seconds,
        "fidelity": report.fidelity.as_dict(),
        "notes": report.notes,
    }
    return json.dumps(found, default=str)


def make_page(mesh: TetMesh, surface: Any, title: str, up: str, height: int) -> Page:
    """The page of a mesh, with a surface around it that may be None."""
    nothing = np.empty((0, 3))
    vertices, faces = as_soup(nothing, nothing) if surface is None else as_soup(surface)
    report = mesh.__dict__.get("report")
    return Page(_core.report_page(mesh._handle, vertices, faces, title, up, _as_json(report)), height)
