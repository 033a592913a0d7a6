"""The least and the greatest value that functions and methods of a platform return (`values.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.project import read_data


@cache
def returned_values(platform: str) -> Mapping[str, tuple[int, int]]:
    """Name of a function or method -> the least and the greatest value; empty for a platform without data.

    Raises:
        PlatformDataError: the data is damaged.
    """
    if not any((folder / platform / _FILE).is_file() for folder in resources.folders("platform_repo")):
        return {}
    path = resources.find("platform_repo", f"{platform}/{_FILE}")
    table = DataTable(path, read_data(path))
    found: dict[str, tuple[int, int]] = {}
    for kind in ("functions", "methods"):
        entries = table.table(kind, needed=False)
        for name in entries.values:
            ends = entries.numbers(name)
            if len(ends) != 2 or ends[0] > ends[1]:
                raise entries.error(name, "must be the least and the greatest value")
            found[name] = ends[0], ends[1]
    return found


@cache
def macros_of_operands(platform: str) -> frozenset[str]:
    """Macros of a platform whose result has the type that their arguments have together; empty for a platform without data.

    Raises:
        PlatformDataError: the data is damaged.
    """
    return _macros(platform, "macros_of_operands")


@cache
def macros_of_bits(platform: str) -> frozenset[str]:
    """Macros of a platform that write a bit of their first argument, whose number is the second; empty without data.

    Raises:
        PlatformDataError: the data is damaged.
    """
    return _macros(platform, "macros_of_bits")


def _macros(platform: str, key: str) -> frozenset[str]:
    if not any((folder / platform / _FILE).is_file() for folder in resources.folders("platform_repo")):
        return frozenset()
    path = resources.find("platform_repo", f"{platform}/{_FILE}")
    return frozenset(DataTable(path, read_data(path)).texts(key, ()))


_FILE = "values.toml"
