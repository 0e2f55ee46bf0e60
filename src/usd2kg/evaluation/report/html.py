"""Reports as one self-contained HTML file, without scripts or external resources."""

import html
import re
from collections.abc import Sequence

from usd2kg.evaluation.report.blocks import Figure, Section, Table, printable

__all__ = ["escape_html", "format_html"]

_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
"""Content Security Policy: the page loads nothing; its styles are inline."""
_STYLE = """
:root { color-scheme: light; --ink: #1d2430; --soft: #5b6575; --line: #dfe3ea; --tint: #f5f7fa; --accent: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 72rem; padding: 2.5rem 1.5rem 4rem; color: var(--ink); background: #fff;
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 1rem; }
h2 { font-size: 1.35rem; margin: 3rem 0 1rem; padding-bottom: .3rem; border-bottom: 2px solid var(--line); }
p { max-width: 48rem; overflow-wrap: anywhere; }
nav { display: flex; flex-wrap: wrap; gap: .4rem 1.2rem; padding: .7rem 1rem; background: var(--tint);
  border-radius: 8px; }
a { color: var(--accent); text-decoration: none; }
a:hover, a:focus { text-decoration: underline; }
.table { margin: 1.6rem 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; }
h3, summary { font-size: .95rem; font-weight: 600; margin: 0; padding: .3rem 0; }
summary { cursor: pointer; }
th, td { padding: .35rem .8rem .35rem .2rem; border-bottom: 1px solid var(--line); text-align: left;
  vertical-align: top; overflow-wrap: break-word; max-width: 34rem; }
th { color: var(--soft); font-weight: 600; vertical-align: bottom; border-bottom: 2px solid var(--ink);
  max-width: 9.5rem; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
th.number { white-space: normal; }
tbody tr:hover { background: var(--tint); }
.note { color: var(--soft); font-size: .85rem; margin: .4rem 0 0; }
figure { margin: 1.6rem 0; }
figure svg { max-width: 100%; height: auto; }
figcaption { color: var(--soft); font-size: .88rem; max-width: 48rem; }
@media print { nav { display: none; } h2 { break-after: avoid; } figure, tr { break-inside: avoid; } }
"""
_NUMERIC_CELL = re.compile(r"(fail|–|< ?)?[\d\s.,±/%×to-]*")


def escape_html(text: str) -> str:
    """Return text escaped for HTML content and attributes.

    >>> escape_html("<script>alert('1')</script>")
    '&lt;script&gt;alert(&#x27;1&#x27;)&lt;/script&gt;'
    """
    return html.escape(printable(text), quote=True)


def format_html(title: str, sections: Sequence[Section]) -> str:
    """Return the report as an HTML page."""
    contents = " ".join(f'<a href="#s{i}">{escape_html(s.title)}</a>' for i, s in enumerate(sections, 1))
    body = "\n".join(_section(section, index) for index, section in enumerate(sections, 1))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{escape_html(_POLICY)}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape_html(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{escape_html(title)}</h1>\n<nav>{contents}</nav>\n{body}\n</body>\n</html>\n"
    )


def _section(section: Section, index: int) -> str:
    blocks = [_block(block, f"s{index}b{at}") for at, block in enumerate(section.blocks)]
    return f'<section id="s{index}">\n<h2>{escape_html(section.title)}</h2>\n' + "\n".join(blocks) + "\n</section>"


def _block(block: str | Table | Figure, key: str) -> str:
    if isinstance(block, Table):
        return _table(block)
    if isinstance(block, Figure):
        return _figure(block, key)
    return f"<p>{escape_html(block)}</p>"


def _table(table: Table) -> str:
    numeric = [all(_NUMERIC_CELL.fullmatch(row[at]) for row in table.rows) for at in range(len(table.columns))]
    title = escape_html(table.title)
    head = _row("th", table.columns, numeric)
    rows = "\n".join(_row("td", row, numeric) for row in table.rows)
    note = f'\n<p class="note">{escape_html(table.note)}</p>' if table.note else ""
    body = f'<table aria-label="{title}">\n<thead>{head}</thead>\n<tbody>\n{rows}\n</tbody></table>'
    grid = f'<div class="scroll">{body}</div>'
    if table.is_long:
        grid = f"<details><summary>{title}, {len(table.rows)} rows</summary>\n{grid}\n</details>"
    else:
        grid = f"<h3>{title}</h3>\n{grid}"
    return f'<div class="table">{grid}{note}</div>'


def _row(tag: str, cells: Sequence[str], numeric: Sequence[bool]) -> str:
    kinds = ['class="number"' if is_number else "" for is_number in numeric]
    inner = "".join(
        f"<{f'{tag} {kind}'.strip()}>{escape_html(cell)}</{tag}>" for cell, kind in zip(cells, kinds, strict=True)
    )
    return f"<tr>{inner}</tr>"


def _figure(figure: Figure, key: str) -> str:
    # Ids must be unique on the page, and all plots use the same ones.
    svg = re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{key}-", figure.svg)
    caption = escape_html(figure.caption)
    svg = svg.replace("<svg ", f'<svg role="img" aria-label="{caption}" ', 1)
    return f"<figure>{svg}<figcaption>{caption}</figcaption></figure>"
