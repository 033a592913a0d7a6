"""Rows of facts about libraries as in lines of JSON: `installed_libraries` makes them, `library_index` reads them."""

from __future__ import annotations

from typing import Required, TypedDict

from robosmi.base.data_text import Json


class HeaderRow(TypedDict, total=False):
    """One header of a library: how often each word and each identifier's word occurs in it, and what it includes."""

    file: Required[str]
    main: Required[bool]
    raw: Required[dict[str, int]]
    idents: dict[str, int]
    includes: list[str]


class LibraryRow(TypedDict, total=False):
    """One library.

    `meta_terms` and `keyword_terms` are words with how often they come, `api` is what its headers declare, a row each
    (`library_index`).
    """

    name: Required[str]
    main: Required[list[str]]
    headers: Required[list[HeaderRow]]
    repo: str
    commit: str
    path: str
    version: str
    author: str
    category: str
    architectures: list[str]
    depends: list[str]
    license: str
    url: str
    installed: bool
    in_registry: bool
    copies: int
    meta_terms: dict[str, int]
    keyword_terms: dict[str, int]
    keyword_classes: list[str]
    api: list[dict[str, Json]]
    registers: list[str]
