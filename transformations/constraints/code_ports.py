"""Constraints on the ports of a moved program: numbers that are no port of the source, and numbers known only at run time.

Which target pins the ports are on is checked on the plan's bindings (`plan_ports`).
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode, migration
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.constraints.code_move import in_lines, move, moved, place, the_move, together
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.pin_uses import PinUse, macro_pin_uses, names_its_ports, negative_uses_of, pin_uses_of
from robosmi.transformations.queries.flows.pointed_calls import called_name
from robosmi.transformations.queries.flows.pointers import pointed_functions
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.plans.waiting_calls import lacks_pin
from robosmi.transformations.queries.ports.expanded_calls import ExpandedCalls
from robosmi.transformations.queries.ports.register_bits import register_bits, sets_bits
from robosmi.transformations.queries.programs.main_locals import is_constant
from robosmi.validate import Fail

_SHOWN = 4
"""How many numbers a message lists."""

units = moved.context(ccode.SourceUnit, guard=lambda _: move() is not None)


def _correction(_: ccode.SourceUnit) -> str:
    """The advice for a number that is no port, with what the call does until then."""
    if retains_platform(the_move().plan):
        return "correct the number, or give the sketch's board with --from; until then the target takes it for a pin of its own"
    return "correct the number; until then the call does nothing on the target"


@units.constraint(id="RS326", severity=Severity.warning, location=place, advice=_correction)
def PortIsOfTheSource(u: ccode.SourceUnit) -> bool | Fail:
    """A number that is used as a port is a port of the source board."""
    m = the_move()
    view = m.view(u)
    count = view.api.ports
    uses = [*pin_uses_of(view, m.views), *macro_pin_uses(view), *register_bits(view, m.masks)]
    wrong = [use for use in uses if use.pin is not None and use.pin >= count]
    wrong += [use for use in negative_uses_of(view) if use.function not in _signed(m.plan)]
    numbers = sorted({use.pin for use in wrong if use.pin is not None})
    shown = numbers[:_SHOWN]
    if retains_platform(m.plan):
        said = ", ".join(map(str, shown))
    else:
        said = "; ".join(f"{number}; functions that shift a bit by it change port {number % count}" for number in shown)
    said += f"; and {len(numbers) - _SHOWN} more" * (len(numbers) > _SHOWN)
    return not wrong or together(
        f"the source has ports 0 to {count - 1} only, but the program uses {said}", [u.call for u in wrong]
    )


def _bind_each(u: ccode.SourceUnit) -> str:
    """The advice for ports that only the running program knows, with a port as the source platform calls it."""
    name = the_move().view(u).api.port_name(4)
    given = f'--bind {name}=PIN or [bind] {name} = "PIN"'
    return f"bind each further port that it can be, with {given}; if there is none, bind any other port to none"


@units.constraint(
    id="RS327", severity=Severity.warning, location=place,
    advice=_bind_each,
)  # fmt: skip
def PortsAreKnown(u: ccode.SourceUnit) -> bool | Fail:
    """The ports passed to a function or register are known statically; it is info once one is bound (`severity_by`)."""
    found = list(_unknown(u))
    names = ", ".join(dict.fromkeys(name for name, _ in found))
    places = [element for _, element in found]
    return not found or Fail(
        f"the ports that the program passes to {names} are known only at run time ({in_lines(places)})", places=tuple(places)
    )


def _signed(plan: migration.MigrationPlan) -> set[str]:
    """Functions for which negative numbers have a meaning of their own, and functions without an adapter, where this is
    unknown.
    """
    return {str(use.name) for use in plan.adapterUses if use.adapter is None or any(pin.signed for pin in use.adapter.pins)}


def _unknown(u: ccode.SourceUnit) -> Iterator[tuple[str, ccode.Located]]:
    """The calls, macros and register accesses of a unit whose ports are not known statically, as (name, element)."""
    m = the_move()
    view = m.view(u)
    flows = [flow for flow in m.plan.portFlows if flow.anything and not lacks_pin(flow)]
    calls = [call for flow in flows for call in flow.calls if ancestor_of_kind(call, ccode.SourceUnit) is u]
    yield from ((f"'{called_name(call)}'", call) for call in calls if not names_its_ports(call, view))
    used = ExpandedCalls(m.views).used if any(not flow.calls for flow in flows) else frozenset()
    places = {int(change.startOffset) for flow in flows if not flow.calls for change in flow.changes if change.unit is u}
    macros = [c for c in u.macros if str(c.name) in used and any(c.startOffset <= at < c.endOffset for at in places)]
    yield from ((f"'{macro.name}'", macro) for macro in macros)
    bits: list[PinUse] = register_bits(view, m.masks)
    yield from (
        (f"'{use.function}'", use.call) for use in bits if use.pin is None and (use.direction != "unknown" or sets_bits(use.call))
    )


@units.constraint(id="RS335", location=place, advice="write these calls without the macro")
def PortsOfMacrosAreLookedUp(u: ccode.SourceUnit) -> bool | Fail:
    """A port that a macro passes to a platform function has a place in the text where its pin can be looked up."""
    calls = [c for flow in the_move().plan.portFlows if lacks_pin(flow) for c in flow.calls]
    here = [c for c in calls if ancestor_of_kind(c, ccode.SourceUnit) is u]
    names = ", ".join(dict.fromkeys(f"'{called_name(call)}'" for call in here))
    wrong = f"macros pass {names} a port inside a longer text, so its pin cannot be looked up"
    return not here or Fail(f"{wrong}: these calls get no pin ({in_lines(here)})", places=tuple(here))


@units.constraint(
    id="RS328", severity=Severity.warning, location=place,
    advice="call the platform's function from a function of the program, and point to that function",
)  # fmt: skip
def PointersTellNumbersApart(u: ccode.SourceUnit) -> bool | Fail:
    """No pointer can hold both platform functions, which take target pins, and the program's, which take source numbers."""
    m = the_move()
    platform, own = pointed_functions(m.views)
    here = [reference for reference, view in platform if view.unit is u] if own else []
    names = ", ".join(dict.fromkeys(f"'{reference.name}'" for reference in here))
    wrong = f"a pointer may call {names} with numbers of the source, which are other pins on the target"
    return not here or Fail(f"{wrong} ({in_lines(here)})", places=tuple(here))


@units.constraint(
    id="RS350", severity=Severity.warning, location=place,
    advice="use the register by its name, in a function of the program if several places need it",
)  # fmt: skip
def PortRegistersHaveNoAddress(u: ccode.SourceUnit) -> bool | Fail:
    """No pointer or cast reaches the object that stands for a register of ports on the target, since that drives no pin.

    A target programmed in C has a number in memory instead, whose changes reach the pins.
    """
    m = the_move()
    view = m.view(u)
    if retains_platform(m.plan) or target_of(m.plan).language == "C":
        return True
    names = set(view.api.settings.get("ports", {}).get("registers", {})) - {str(macro.name) for macro in u.macros}
    uses = [r for r in view.of_kind(ccode.NameReference) if r.name in names and _by_address(r)]
    own = (ccode.Variable, ccode.Parameter)
    here = [use for use in uses if not isinstance(use.target, own)]
    shown = ", ".join(dict.fromkeys(f"'{use.name}'" for use in here))
    wrong = f"the program uses {shown} through its address, where the target has no pins ({in_lines(here)})"
    return not here or Fail(wrong, places=tuple(here))


def _by_address(reference: ccode.NameReference) -> bool:
    """Whether an expression takes the address of a name, or makes it a reference to another type."""
    outer = reference.eContainer()
    if isinstance(outer, ccode.Cast):
        return outer.target is not None and str(outer.target.spelling).rstrip().endswith("&")
    return isinstance(outer, ccode.Unary) and str(outer.operator) == "&"


@units.constraint(
    id="RS351", severity=Severity.warning, location=place,
    advice="use what the platform offers for this, by its name; write down what is at the address on the source",
)  # fmt: skip
def NoAddressIsANumber(u: ccode.SourceUnit) -> bool | Fail:
    """No pointer through which the program reads or writes is made of a number, since something else is there on the target."""
    m = the_move()
    view = m.view(u)
    if retains_platform(m.plan):
        return True
    here = [
        cast for cast in view.of_kind(ccode.Cast) if _is_pointer(cast.target) and _is_used(view, cast) and _is_number(view, cast)
    ]
    wrong = f"the program uses a fixed address, where the target has something else ({in_lines(here)})"
    return not here or Fail(wrong, places=tuple(here))


def _is_pointer(kind: ccode.TypeUse | None) -> bool:
    return kind is not None and int(kind.pointerDepth) > 0


def _is_used(view: CodeView, cast: ccode.Cast) -> bool:
    """Whether a pointer is looked through where it is made, kept, or given to a function of C; others are often marks only."""
    outer = cast.eContainer()
    while isinstance(outer, ccode.Binary) and outer.operator in ("+", "-"):
        outer = outer.eContainer()
    if isinstance(outer, (ccode.Assignment, ccode.Variable, ccode.InitializerList)):
        kind = cast.target
        of_nothing = isinstance(cast.operand, ccode.Unary) or (kind is not None and str(kind.spelling).startswith("void"))
        return not of_nothing and not _is_null(cast)
    if isinstance(outer, ccode.Call):
        return view.kind(str(outer.calleeName)) == "standard" and not _is_null(cast)
    through = isinstance(outer, ccode.Unary) and outer.operator == "*"
    return through or (isinstance(outer, ccode.Member) and bool(outer.arrow)) or isinstance(outer, ccode.Index)


def _is_null(cast: ccode.Cast) -> bool:
    return isinstance(cast.operand, ccode.IntegerLiteral) and cast.operand.text.strip("0xXuUlL") == ""


def _is_number(view: CodeView, cast: ccode.Cast) -> bool:
    """Whether the value of a cast is a number that the text alone gives, and no address."""
    operand = cast.operand
    if operand is None or any(_is_address(each) for each in all_contents(operand)):
        return False
    found = view.values.of(operand)
    return is_constant(operand) or (bool(found) and all(value.number is not None for value in found))


def _is_address(part: object) -> bool:
    """Whether a part of an expression is a text, an array, a pointer or a function, or takes an address."""
    if isinstance(part, ccode.NameReference):
        use = part.target.valueType if isinstance(part.target, ccode.Variable) else None
        return isinstance(part.target, ccode.Function) or (use is not None and (bool(use.arrayDims) or _is_pointer(use)))
    return isinstance(part, ccode.StringLiteral) or (isinstance(part, ccode.Unary) and str(part.operator) == "&")
