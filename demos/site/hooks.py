# What mkdocs does to pages on the way: tables without a head lose it, and long code and tables get what narrow screens need.
"""Hooks of mkdocs, named in mkdocs.yml."""
import re
from typing import Any

EMPTY_HEAD = re.compile(r"<thead>\s*<tr>\s*(?:<th[^>]*></th>\s*)+</tr>\s*</thead>")


def on_page_content(html: str, **_: Any) -> str:
    """Tables of pictures are marked as such, for style.css."""
    def marked(table: "re.Match[str]") -> str:
        pictures = " class=\"pictures\"" if "<img" in table[0] else ""
        return EMPTY_HEAD.sub("", table[0].replace("<table>", f"<table{pictures}>", 1))
    return re.sub(r"<table>.*?</table>", marked, html, flags=re.DOTALL)
