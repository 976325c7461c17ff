"""Ready-made progress callbacks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

#: Called with a stage's name and the done fraction, 0..1; answering False cancels.
Progress = Callable[[str, float], bool | None]


def tqdm_progress(**settings: Any) -> Progress:
    """A progress callback that draws a tqdm bar for each stage; `settings` go to `tqdm.auto.tqdm`.

    Raises:
        ImportError: where tqdm is not installed.

    Example:
        >>> mesh = tetsoup.tetrahedralize("bunny.ply", progress=tetsoup.tqdm_progress(leave=False))
    """
    from tqdm.auto import tqdm

    bar: Any = None

    def show(stage: str, fraction: float) -> bool:
        nonlocal bar
        if bar is None or bar.desc != stage or fraction < bar.n:
            if bar is not None:
                bar.close()
            layout = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}"
            bar = tqdm(**{"total": 1.0, "bar_format": layout, **settings})
            bar.set_description_str(stage)
            bar.desc = stage
        bar.update(fraction - bar.n)
        if fraction >= 1:
            bar.close()
        return True

    return show
