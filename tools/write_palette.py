"""Write web/src/state/palette.ts: the colours of `knowledge/settings/coloring.toml` for the page of the studio.

Usage: python -m tools.write_palette [--check]
"""

from collections.abc import Sequence

from tools.data_files import ROOT
from tools.generated_docs import write_or_check
from usd2kg.diagrams.settings import COLORS, CONFIDENCE

PAGE = ROOT / "web" / "src" / "state" / "palette.ts"


def main() -> None:
    """Write the module, or check it."""
    text = f"""/** Colours of objects, sRGB. Written by tools/write_palette.py from knowledge/settings/coloring.toml. */

export const CATEGORIES = {_array(COLORS.categories)} as const;
export const REST = "{COLORS.rest}";
export const ANSWER = "{COLORS.answer}";
export const CONFIDENCE_BOUNDS = [{", ".join(f"{bound:g}" for bound in CONFIDENCE.lower_bounds)}] as const;
export const CONFIDENCE_COLORS = {_array(CONFIDENCE.colors)} as const;
"""
    write_or_check(PAGE, text, "tools.write_palette")


def _array(colors: Sequence[str]) -> str:
    """Return colours as an array in TypeScript, on one line if it fits, as the formatter of the page wants it."""
    row = ", ".join(f'"{color}"' for color in colors)
    return f"[{row}]" if len(row) < 80 else "[\n" + "".join(f'  "{color}",\n' for color in colors) + "]"


if __name__ == "__main__":
    main()
