"""The script of cases/evl/fix_delete, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail, Fix


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Section).constraint
    def NotEmpty(s: Any) -> Any:
        return s.items or s.sections or Fail(f"empty {s.name}", Fix(f"delete {s.name}", lambda: M.delete(s)))

    @v.context(M.Author).constraint
    def Writes2(a: Any) -> Any:
        def add_book() -> None:
            b = M.Comic(name=f"By {a.name}")
            b.authors.append(a)
            M.Section.all[-1].items.append(b)

        new = Fix(f"new book for {a.name}, now {len(M.Book.all)} books", add_book)
        return len(a.books) > 2 or Fail(f"{a.name} wrote {len(a.books)}", new)

    return v
