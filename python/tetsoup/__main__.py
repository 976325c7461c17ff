"""The command-line tool: ``python -m tetsoup`` is ``tetsoup``."""

from __future__ import annotations

import os
import pathlib
import sys


def main() -> None:
    tool = pathlib.Path(__file__).parent / "bin" / "tetsoup"
    os.execv(tool, [str(tool), *sys.argv[1:]])


if __name__ == "__main__":
    main()
