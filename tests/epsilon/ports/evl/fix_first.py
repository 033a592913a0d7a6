"""The script of cases/evl/fix_first, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fix


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    def give_to_cy(b: Any) -> None:
        b.authors.append(M.Author.all[-1])
        b.tags.append("fixed")

    def halve(b: Any) -> None:
        b.price = b.price / 2

    @book.constraint(
        message=lambda b: b.name,
        fixes=[
            Fix(
                lambda b: f"give {b.name} to Ada",
                lambda b: b.authors.append(M.Author.all[0]),
                guard=lambda b: b.year > 1900,
            ),
            Fix("give it to Cy", give_to_cy),
        ],
    )
    def HasAuthor(b: Any) -> Any:
        return b.authors

    @book.critique(message=lambda b: f"{b.name} {b.price}", fixes=[Fix(lambda b: f"halve {b.price}", halve)])
    def Cheap(b: Any) -> Any:
        return b.price < 20

    @v.post
    def _() -> None:
        print("post sees", ", ".join(str(b.price) for b in M.Book.all))

    return v
