"""Eleven short scripts, each ends in a picture in results/own: `.venv/bin/python -m examples.convection`.

SIZE=quick makes them small, as the tests run them. `python -m studies.report gallery` puts those of the usual
size into the gallery of the page.
"""
import os
from pathlib import Path
from typing import Any


def picture(name: str) -> Path:
    """Path of the picture of an example; prints it."""
    path = Path("results/own")/f"{name}.png"
    print("picture:", path)
    return path


def sized(usual: Any, quick: Any) -> Any:
    """The value `quick` if SIZE is quick, else `usual`."""
    return quick if os.environ.get("SIZE") == "quick" else usual
