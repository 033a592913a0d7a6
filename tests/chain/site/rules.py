"""The functions of chain.toml."""

from __future__ import annotations

from typing import Any

from robosmi.generate import Gen
from robosmi.transform import ETL
from robosmi.validate import EVL, Fail


def constraints(v: EVL, library: Any) -> None:
    """Every book has an author."""
    book = v.context(library.Book)

    @book.constraint
    def HasAuthor(b: Any) -> Any:
        return len(b.authors) > 0 or Fail(f"{b.name} has no author")

    @book.critique
    def Recent(b: Any) -> Any:
        return b.year > 1900 or Fail(f"{b.name} is old")


def to_site(t: ETL, library: Any, prices: Any, site: Any) -> None:
    """A page for each book, with its price from the list."""
    price = {row.title: row.price for row in prices.all_contents()}

    @t.rule(library.Library, to=[site.Site])
    def Whole(library_: Any, whole: Any) -> None:
        whole.title = library_.name
        t.set(whole, pages=library.Book.all)

    @t.rule(library.Book, to=[site.Page], greedy=True)
    def Page(b: Any, page: Any) -> None:
        page.title = b.name
        page.price = str(price.get(b.name, "?"))


def pages(g: Gen, site: Any) -> None:
    """A file for each page, and an index."""

    @g.rule(site.Page, template="page.html", target=lambda p: f"{p.title}.html")
    def PageFile(p: Any) -> None: ...

    @g.rule(site.Site, template="index.html", target="index.html")
    def Index(s: Any) -> None: ...
