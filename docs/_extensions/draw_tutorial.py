"""Draw the pictures of the tutorial anew, by its own commands: `python docs/_extensions/draw_tutorial.py`."""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))
from tests.support.tutorial import follow  # noqa: E402

PICTURES = ROOT / "docs" / "_static" / "your-own-glider"
WIDTH, COLOURS = 1100, 64
"""Enough for curves and letters; a page should load quickly."""


def main() -> None:
    """Follow the page in a folder of its own, and keep what it draws."""
    PICTURES.mkdir(exist_ok=True)
    program = Path(sys.executable).with_name("stommel")
    with TemporaryDirectory() as name:
        folder = Path(name)
        follow(folder, lambda *arguments: subprocess.run([program, *arguments], cwd=folder, check=True))
        drawn = [folder / f"{name}.png" for name in ("hull", "budget", "endurance", "first/map", "first/sawtooth")]
        for path in drawn:
            with Image.open(path) as image:
                height = round(image.height * WIDTH / image.width)
                small = image.convert("RGB").resize((WIDTH, height), Image.Resampling.LANCZOS)
                small.quantize(COLOURS).save(PICTURES / path.name, optimize=True)


if __name__ == "__main__":
    main()
