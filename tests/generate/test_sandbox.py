"""A template cannot reach Python, change a model or write a file, whatever way it tries; what templates need stays.

Each attack names the reason for which it must be refused, so that one that fails for another reason shows nothing.
"""

from __future__ import annotations

import functools
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from robosmi.errors import RuleError
from robosmi.generate import Gen
from robosmi.metamodels import hardware
from robosmi.model import open_model, save_model

PYTHON = [
    ("{{ cycler.__init__.__globals__ }}", "__init__"),
    ("{{ cycler['__init__']['__globals__'] }}", "__init__"),
    ("{{ joiner.__init__.__globals__ }}", "__init__"),
    ("{{ lipsum.__globals__ }}", "__globals__"),
    ("{{ dict.mro() }}", "mro"),
    ("{{ ''.__class__.__mro__ }}", "__class__"),
    ("{{ [''] | map(attribute='__class__.__mro__') | list }}", "__class__"),
    ("{{ '{0.__class__}'.format(x) }}", "__class__"),
    ("{{ ('{0.__class__}' | attr('format'))(x) }}", "__class__"),
    ("{{ ('{0.__class__}' | safe).format(x) }}", "__class__"),
    ("{{ '{x.__class__}'.format_map({'x': x}) }}", "__class__"),
    ("{{ '{x[__class__]}'.format(x=x) }}", "__class__"),
    ("{% set f = '{0.__class__}'.format %}{{ f(x) }}", "__class__"),
    ("{{ (['{0.__class__}'] | map(attribute='format') | first)(x) }}", "__class__"),
    ("{{ out.print.__self__ }}", "__self__"),
    ("{{ out.print.__func__ }}", "__func__"),
    ("{{ out._buffer }}", "_buffer"),
    ("{{ self.__init__ }}", "__init__"),
    ("{{ self._TemplateReference__context }}", "_TemplateReference__context"),
    ("{{ self.b._context }}{% block b %}{% endblock %}", "_context"),
    ("{{ region_id.__globals__ }}", "__globals__"),
    ("{% macro m() %}{% endmacro %}{{ m._func }}", "_func"),
    ("{% macro m() %}{% endmacro %}{{ m._environment }}", "_environment"),
    ("{% macro m() %}{{ caller._func }}{% endmacro %}{% call m() %}{% endcall %}", "_func"),
    ("{% set n = namespace(a=1) %}{{ n._Namespace__attrs }}", "_Namespace__attrs"),
    ("{% for i in [1] %}{{ loop._iterator }}{% endfor %}", "_iterator"),
    ("{% for i in [1] %}{{ loop.__class__ }}{% endfor %}", "__class__"),
    ("{{ (1 | default(missing)).__class__ }}", "__class__"),
    ("{{ generator.gi_frame }}", "gi_frame"),
    ("{{ ([1] | map('upper')).gi_code }}", "gi_code"),
    ("{{ function.__globals__ }}", "__globals__"),
    ("{{ function.__code__ }}", "__code__"),
    ("{{ bound.func }}", "func"),
    ("{{ bound.keywords }}", "keywords"),
    ("{{ module.path }}", "path"),
    ("{{ error.__traceback__ }}", "__traceback__"),
]
MODELS = [
    ("{{ x.__class__ }}", "__class__"),
    ("{{ x['__class__'] }}", "__class__"),
    ("{{ x | attr('__class__') }}", "__class__"),
    ("{{ [x] | map(attribute='__class__') | list }}", "__class__"),
    ("{{ [x] | map('attr', '__class__') | list }}", "__class__"),
    ("{{ [x] | groupby('__class__') }}", "__class__"),
    ("{{ [x] | sort(attribute='__class__') }}", "__class__"),
    ("{{ [x] | selectattr('__class__') | list }}", "__class__"),
    ("{{ x.delete() }}", "delete"),
    ("{{ (x | attr('delete'))() }}", "delete"),
    ("{{ ([x] | map(attribute='delete') | first)() }}", "delete"),
    ("{{ (x.components[0].delete)() }}", "delete"),
    ("{{ x.eSet('name', 'changed') }}", "eSet"),
    ("{{ x.eGet('__class__') }}", "eGet"),
    ("{{ x.eResource }}", "eResource"),
    ("{{ x.notify(1) }}", "notify"),
    ("{{ x.force_resolve() }}", "force_resolve"),
    ("{{ x.allInstances() }}", "allInstances"),
    ("{{ x.eClass.python_class }}", "python_class"),
    ("{{ x.eClass.delete() }}", "delete"),
    ("{% do x.eClass.eStructuralFeatures.clear() %}", "clear"),
    ("{% do x.components.clear() %}", "clear"),
    ("{% do x.components.append(x) %}", "append"),
    ("{% do x.components.update([x]) %}", "update"),
    ("{% do (x | attr('components')).clear() %}", "clear"),
    ("{{ x.components.owner }}", "owner"),
    ("{{ x.components.feature }}", "feature"),
    ("{{ m.save() }}", "save"),
    ("{{ m.create('Circuit') }}", "create"),
    ("{{ m.Circuit.model.save() }}", "model"),
    ("{{ m.Circuit(name='new') }}", "()"),
    ("{% do xml.appendChild(xml) %}", "appendChild"),
    ("{{ xml._node }}", "_node"),
]
FILES = [
    ("{{ p.write_text('x') }}", "write_text"),
    ("{{ p.open('w') }}", "open"),
    ("{{ p.unlink() }}", "unlink"),
    ("{{ p.parent.iterdir() }}", "iterdir"),
    ("{{ p.home() }}", "home"),
]


def generator() -> Any:
    yield 1


def given(folder: Path) -> dict[str, Any]:
    """What the templates of a careless program see."""
    model = hardware.Circuit()
    stored = folder / "circuit.xmi"
    save_model(hardware.Circuit(name="c", path="c.fzz", digest="0" * 64, tool="t", toolVersion="1", view="v"), stored)
    model.components.append(hardware.Component(title="LED"))
    (folder / "a.xml").write_text("<a><b/></a>")
    return {
        "x": model, "p": folder / "out" / "file", "generator": generator(), "function": given, "error": ValueError("x"),
        "bound": functools.partial(open, mode="w"), "module": __import__("os"), "xml": open_model(folder / "a.xml").t_a.all[0],
        "m": open_model(stored),
    }  # fmt: skip


@pytest.mark.parametrize(("attack", "name"), [*PYTHON, *MODELS, *FILES])
def test_a_template_cannot_leave_its_sandbox(attack: str, name: str, tmp_path: Path) -> None:
    seen = given(tmp_path)
    before = len(seen["x"].components)
    with pytest.raises(RuleError) as refused:
        Gen(tmp_path / "out", {"t": attack}).text("t", **seen)
    assert f"a template may not use '{name}' of a " in refused.value.message
    assert len(seen["x"].components) == before
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("attack", "why"),
    [
        ("{% for i in range(999999999) %}{% endfor %}", "Range too big"),
        ("{% include '../a.xml' %}", "there is no template"),
        ("{% include '/etc/passwd' %}", "there is no template"),
        ("{% import 'os' as os %}", "there is no template"),
        ("{{ missing.name }}", "'missing' is undefined"),
    ],
)
def test_other_ways_end_for_their_own_reason(attack: str, why: str, tmp_path: Path) -> None:
    with pytest.raises(RuleError, match=why):
        Gen(tmp_path / "out", {"t": attack}).text("t")


def test_what_templates_need_stays(tmp_path: Path) -> None:
    text = (
        "{{ x.components[0].title }} {{ '{:>4}'.format(7) }} {{ x.eClass.name }} {% set l = [] %}{% do l.append(1) %}{{ l }} "
        "{{ '%s' % x.components[0].title }} {{ p.name }} {{ xml.tagName }} {{ xml.children | length }} "
        "{{ x.components[0].eContainer().eClass.name }} {{ x.components.index(x.components[0]) }} {{ m.Circuit.all | length }} "
        "{{ x.eClass.findEStructuralFeature('nets').name }} {{ own.value }}"
    )
    made = Gen(tmp_path / "out", {"t": text}).text("t", **given(tmp_path), own=SimpleNamespace(value=3))
    assert made == "LED    7 Circuit Sequence {1} LED file a 1 Circuit 0 1 nets 3"
