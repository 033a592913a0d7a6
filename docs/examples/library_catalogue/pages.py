"""EGX: a website to HTML pages; the templates are in `templates`."""


def pages(g, site):
    """An index, and a file for each page."""

    @g.rule(site.Site, template="index.html", target="index.html")
    def Index(s):
        return {"free": site.ItemPage.all.select(lambda p: p.available).size()}

    @g.rule(site.ItemPage, template="item.html", target=lambda p: f"{p.address}.html")
    def Item(p): ...

    @g.rule(site.AuthorPage, template="author.html", target=lambda p: f"authors/{p.address}.html")
    def Author(p): ...
