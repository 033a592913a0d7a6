"""A template cannot reach Python, change a model or write a file, whatever way it tries; what templates need stays."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import RuleError
from robosmi.generate import Gen
from robosmi.metamodels import hardware

ATTACKS = [
    "{{ cycler.__init__.__globals__ }}",
    "{{ cycler['__init__']['__globals__'] }}",
    "{{ x.__class__ }}",
    "{{ x['__class__'] }}",
    "{{ x | attr('__class__') }}",
    "{{ ''.__class__.__mro__ }}",
    "{{ [x] | map(attribute='__class__') | list }}",
    "{{ [''] | map(attribute='__class__.__mro__') | list }}",
    "{{ [x] | map('attr', '__class__') | list }}",
    "{{ '{0.__class__}'.format(x) }}",
    "{{ '{0.__class__}' | attr('format') }}{{ ('{0.__class__}' | attr('format'))(x) }}",
    "{{ ['{0.__class__.__init__}'] | map('attr', 'format') | first }}{{ '{x.__class__}'.format_map({'x': x}) }}",
    "{{ x.delete() }}",
    "{{ x.eSet('name', 'changed') }}",
    "{{ x.eResource }}",
    "{{ x.eGet('__class__') }}",
    "{{ p.write_text('x') }}",
    "{{ x.eClass.python_class }}",
    "{{ x.eClass.delete() }}",
    "{% do x.components.clear() %}",
    "{% do x.components.append(x) %}",
    "{% do (x | attr('components')).clear() %}",
    "{{ out.print.__self__ }}",
    "{{ out._buffer }}",
    "{{ self.__init__ }}",
    "{{ out.print.__func__ }}",
    "{{ region_id.__globals__ }}",
    "{{ (x | attr('delete'))() }}",
    "{{ [x] | map(attribute='delete') | first }}{{ ([x] | map(attribute='delete') | first)() }}",
    "{% for i in range(999999999) %}{% endfor %}",
]


def made(text: str, folder: Path) -> tuple[str, object]:
    model = hardware.Circuit()
    model.components.append(hardware.Component(title="LED"))
    return Gen(folder, {"t": text}).text("t", x=model, p=folder), model


@pytest.mark.parametrize("attack", ATTACKS)
def test_a_template_cannot_leave_its_sandbox(attack: str, tmp_path: Path) -> None:
    with pytest.raises(RuleError):
        made(attack, tmp_path / "out")


def test_what_templates_need_stays(tmp_path: Path) -> None:
    text = "{{ x.components[0].title }} {{ '{:>4}'.format(7) }} {{ x.eClass.name }} {% set l = [] %}{% do l.append(1) %}{{ l }}"
    assert made(text, tmp_path / "out")[0] == "LED    7 Circuit Sequence {1}"
