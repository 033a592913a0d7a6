"""Roles that a user gives to components of a drawing, by title or `#identity` (robosmi.toml, `[roles]`)."""

from __future__ import annotations

from collections.abc import Mapping

from robosmi.errors import UsageError, did_you_mean
from robosmi.project import FILE_NAME
from robosmi.transformations.knowledge.part import ROLES


def given_roles(roles: Mapping[str, str], titles: Mapping[str, str], former: Mapping[str, str] | None = None) -> dict[str, str]:
    """The given roles by identity.

    Args:
        roles: COMPONENT -> role.
        titles: the title of each component that is placed, by identity.
        former: titles that count where no component has them as its title, by identity.

    Raises:
        UsageError: a role or a component does not exist, or a title is not unique.
    """
    result: dict[str, str] = {}
    for name, role in roles.items():
        if role not in ROLES:
            cause = f"unknown role '{role}'{did_you_mean(role, ROLES)} of '{name}' in [roles] of {FILE_NAME}"
            raise UsageError(cause, fix=f"use one of: {', '.join(ROLES)}")
        found = [identity for identity, title in titles.items() if name in (f"#{identity}", title)]
        found = found or [identity for identity, title in (former or {}).items() if name == title]
        if len(found) != 1:
            known = sorted({title for title in titles.values() if title})
            cause = f"{len(found)} components are called '{name}'" if found else f"unknown component '{name}'"
            fix = f"use one of: {', '.join(f'#{i}' for i in found) if found else ', '.join(known)}"
            named = f", to which [roles] of {FILE_NAME} gives '{role}'"
            raise UsageError(cause + ("" if found else did_you_mean(name, known)) + named, fix=fix)
        result[found[0]] = role
    return result
