"""The documentation as a site: `python -m tests.site_pages FOLDER` (make docs) builds it offline with Material for MkDocs.

`sources` collects the pages of the repository, `references` makes those that come from the code, and `links` checks the result.
"""
