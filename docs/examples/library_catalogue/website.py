"""ETL: a catalogue and the opening hours to a website."""


def address(text):
    """A text as a part of a URL."""
    return "-".join(text.lower().split())


def to_website(t, catalogue, opening, site):
    """A page for each item, and for each author of one."""

    @t.rule
    def Library2Site(library: catalogue.Library, s: site.Site):
        s.title = library.name
        s.hours.extend([f"{row.day} {row.opens}-{row.closes}" for row in opening.hours.all])
        t.set(s, pages=library.items)  # s.pages ::= library.items

    @t.rule(abstract=True)
    def Item2Page(i: catalogue.Item, page: site.ItemPage):
        page.title = i.title
        page.available = i.loan is None
        t.set(page, by=i.authors)

    @t.rule(extends=[Item2Page])
    def Book2Page(b: catalogue.Book, page: site.ItemPage):
        page.address = b.isbn or address(b.title)
        page.facts.extend([f"of {b.year}", *(genre.name for genre in b.genre)])

    @t.rule(extends=[Item2Page])
    def Magazine2Page(m: catalogue.Magazine, page: site.ItemPage):
        page.address = address(f"{m.title} {m.year} {m.issue}")
        page.facts.append(f"issue {m.issue} of {m.year}")

    @t.rule(lazy=True)  # only authors whom an item asks for
    def Author2Page(a: catalogue.Author, page: site.AuthorPage):
        page.title = a.name
        page.address = address(a.name)
        t.equivalent(a.eContainer()).people.append(page)
