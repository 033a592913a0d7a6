"""EVL: what a catalogue must be like before it is published."""

from robosmi.validate import Fail, Fix


def check_digit(isbn):
    """The 13th digit of an ISBN, from the twelve before it."""
    return str(-sum(int(digit) * (1, 3)[place % 2] for place, digit in enumerate(isbn[:12])) % 10)


def constraints(v, catalogue, opening):
    """Errors stop the chain, critiques are reported."""
    item = v.context(catalogue.Item)

    @item.constraint
    def HasTitle(i):
        name = Fix("call it Untitled", lambda: setattr(i, "title", "Untitled"))
        return bool(i.title) or Fail(f"the item {catalogue.id_of(i)} has no title", name)

    @item.critique(guard=lambda i: v.satisfies(i, "HasTitle"))
    def HasAuthor(i):
        return i.authors or Fail(f"{i.title} has no author")

    book = v.context(catalogue.Book, guard=lambda b: bool(b.isbn))

    @book.constraint
    def Isbn(b):
        return (len(b.isbn) == 13 and b.isbn.isdigit()) or Fail(f"{b.title}: {b.isbn} is no ISBN of 13 digits")

    @book.constraint(guard=lambda b: v.satisfies(b, "Isbn"))
    def CheckDigit(b):
        right = b.isbn[:12] + check_digit(b.isbn)
        mend = Fix(f"make it {right}", lambda: setattr(b, "isbn", right))
        return b.isbn == right or Fail(f"{b.title}: the check digit of {b.isbn} is wrong", mend)

    @v.context(catalogue.Author).critique(info=True)
    def HasItem(a):
        return a.items or Fail(f"nothing by {a.name} is in the catalogue")

    @v.critique
    def OpenOnSaturday():  # another model, another technology
        return opening.hours.all.exists(lambda row: row.day == "Saturday") or Fail("closed on Saturdays")
