"""A query given as text runs nothing, changes no model and makes no giant number; each attack names the reason of its refusal."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.model.emf import EmfModel
from robosmi.query.answers import as_json
from robosmi.query.expression import evaluate

CASE = Path(__file__).parents[1] / "model" / "drivers" / "cases" / "emf"
META = "Book.all.first().eClass.eClass"

MODELS = [
    ("(lambda p: p.getEClassifier('EClass')('Foo').eOperations.append(p.getEClassifier('EOperation')"
     "('x(a=list(map(eval,[\"__import__(\\\"os\\\").system(\\\"id\\\")\"])))->f')))(Book.all.first().eClass.eClass.ePackage)",
     "may not use 'getEClassifier'"),
    (f"{META}.ePackage.getEClassifier('EClass')", "may not use 'getEClassifier'"),
    (f"{META}('Foo')", "may not call the type EClass"),
    (f"{META}.ePackage.eClassifiers[0]('Foo')", "may not call the type"),
    (f"get(get({META}, 'ePackage'), 'eClassifiers').first()('Foo')", "may not call the type"),
    (f"[c('Foo') for c in get({META}.ePackage, 'eClassifiers')]", "may not call the type"),
    (f"Q(['Foo']).collect({META})", "may not call the type EClass"),
    (f"call(['Foo'], 'collect', {META})", "may not call the type EClass"),
    (f"call_built_in(['Foo'], 'sortBy', {META})", "may not call the type EClass"),
    (f"Q(['Foo']).aggregate(lambda x: x, lambda x, t: t, {META})", "may not call the type EClass"),
    (f"Q(['Foo']).lazy().collect({META}).list()", "may not call the type EClass"),
    (f"['Foo'].sort(key={META})", "may not call the type EClass"),
    (f"elvis(None, {META})", "may not call the type EClass"),
    (f"call(True, 'and', {META})", "may not call the type EClass"),
    (f"Q([None]).aggregate(lambda x: 1, elvis, lambda x: {META})", "may not pass 'elvis' on"),
    ("Q(['x']).aggregate(lambda x: 1, call, 'nativeType')", "may not pass 'call' on"),
    ("Book(name='x')", "may not call the type Book"),
    ("M.Book(name='x')", "may not call the type Book"),
    ("M['Book'](name='x')", "may not call the type Book"),
    ("type_of(Book.all.first())(name='x')", "may not call the type Book"),
    ("Q([1]).collect(Book)", "may not call the type Book"),
    ("call(Book, 'createInstance')", "may not use the operation 'create_instance'"),
    ("get(Book, 'createInstance')", "may not use the operation 'create_instance'"),
    ("Q([Book]).createInstance", "may not use the operation 'create_instance'"),
    ("Q([Book]).get('createInstance')", "may not make an element|may not use the operation"),
    ("call(M, 'deleteElement', Book.all.first())", "may not use the operation 'delete_element'"),
    ("Book.all.first().eClass.eOperations.append(1)", "may not use 'append'"),
    ("Shelf.all.first().books.clear()", "may not use 'clear'"),
    ("Shelf.all.first().books.owner", "may not use 'owner'"),
    ("Book.all.first().delete()", "may not use 'delete'"),
    ("Book.all.first().eGet('eResource')", "may not use 'eGet'"),
    ("Book.all.first().eGet('__class__')", "may not use 'eGet'"),
    ("Book.all.first().eGet('__reduce_ex__')(2)", "may not use 'eGet'"),
    ("Book.all.first().eGet('__setattr__')('name', 'x')", "may not use 'eGet'"),
    ("Book.all.first().eSet('name', 'x')", "may not use 'eSet'"),
    ("Book.all.first().eClass.python_class", "may not use 'python_class'"),
    ("call(Book.all.first(), 'eResource')", "may not use the operation 'e_resource'"),
    ("get(Book.all.first(), 'eResource')", "may not use the operation 'e_resource'"),
]  # fmt: skip
PYTHON = [
    ("Q([Book.all.first()]).get('__class__')", "may not use '__class__'|has no property '__class__'"),
    ("Q([Book.all.first()]).get('__class__.__mro__')", "may not use|has no property"),
    ("Q([Book.all.first()]).get('__reduce_ex__').first()(2)", "may not use|has no property"),
    ("Q([Book.all.first()]).get('eClass.python_class').first()('x')", "has no property"),
    ("Book.all.get('listeners')", "has no property 'listeners'"),
    ("call(1, 'nativeType')", "may not use the operation 'native_type'"),
    ("get(1, 'nativeType')", "may not use the operation 'native_type'"),
    ("Q([1]).nativeType.first()('7')", "may not use the operation 'native_type'"),
    ("Q([1]).get('nativeType').first()('7')", "may not use the operation 'native_type'"),
    ("e_cross_references(Tuple(eClass=Tuple(eGenericSuperTypes=[], eSuperTypes=[], eStructuralFeatures=[Tuple(is_reference=True,"
     " containment=False, derived=False, eOpposite=None, many=False, name='__init__')]))).first()([])", "unhashable type"),
    ("Lazy([1]).eager().list().sort(key=println.__call__)", "may not use '__call__'"),
    ("('{0.__class__}'.format)(1)", "may not use 'format'"),
    ("Q([1])[0].to_bytes(10, 'big')", "may not use 'to_bytes'"),
    ("type_named('Any').is_kind(1)", "may not use 'is_kind'"),
    ("Book.model", "may not use 'model'"),
    ("Book.kind", "may not use 'kind'"),
    ("get(M, 'model')", "has no property 'model'"),
    ("call(M, '_target', 'x')", "may not use '_target'"),
]  # fmt: skip
NUMBERS = [
    ("9**9**9", "more than 100,000 bits"),
    ("(lambda f, n, x: f(f, n - 1, x * x) if n else x)(lambda f, n, x: f(f, n - 1, x * x) if n else x, 40, 9)", "100,000 bits"),
    ("1 << 10**9", "more than 100,000 bits"),
    ("'x' * 10**10", "the repetition has more than"),
    ("10**10 * [1]", "the repetition has more than"),
    ("f'{1:{10**9}}'", "asks for more than"),
    ("f'{1:999999999}'", "asks for more than"),
    ("'%999999999d' % 1", "asks for more than"),
    ("format_(1, '%999999999d')", "asks for more than"),
    ("call(1.5, 'format', '%.999999999f')", "asks for more than"),
    ("get(1, '~__class__')", "may not use '~__class__'"),
    ("get_all([1], '~__init__')", "may not use '~__init__'"),
    ("'%*d' % (10**9, 1)", "may not take its width from a value"),
    ("'x'.ljust(10**10)", "ljust of 1e[+]10 is more than"),
    ("repeat('x', 2**30)", "repeat of"),
    ("call('x', 'repeat', 2**30)", "repeat of"),
    ("call(1, 'to', 2**30)", "to of"),
    ("integer_range(1, 2**30)", "integer_range of"),
    ("Q(integer_range(1, 40)).powerset()", "the powerset of more than"),
]


@pytest.mark.parametrize(("attack", "why"), [*MODELS, *PYTHON, *NUMBERS])
def test_an_attack_is_refused_for_its_reason(attack: str, why: str) -> None:
    model = EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore", "M")
    before = len(list(model.all_contents()))
    with pytest.raises(RobosmiError, match=why) as refused:
        as_json(evaluate(attack, [model]))
    assert refused.value.exit_code in (2, 3)
    assert len(list(model.all_contents())) == before


def test_the_attack_that_ran_a_command_is_refused_without_its_names() -> None:
    model = EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore", "M")
    text = "'x(a=list(map(eval,[1])))->f'"
    made = f"p.getEClassifier('EOperation')({text})"
    attack = f"(lambda p: p.getEClassifier('EClass')('Foo').eOperations.append({made}))({META}.ePackage)"
    with pytest.raises(RobosmiError, match="may not use 'getEClassifier'"):
        evaluate(attack, [model])


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("2**100", 2**100),
        ("7 % 4 + 3 * 2 + (1 << 4)", 25),
        ("'ab' * 3 + '%03d' % 7", "ababab007"),
        ("f'{3.14159:.2f} {7:>{4}}'", "3.14    7"),
        ("Q([3, 1, 2]).sort_by(negative)", [3, 2, 1]),
        ("Q([[1], [2]]).collect(Q).flatten()", [1, 2]),
        ("elvis(None, lambda: 3)", 3),
        ("Book.all.of_kind(Comic).size() + Book.all.select(lambda b: b.pages > 1, kind=Comic).size()", 2),
        ("Shelf.all.first().books.index(Shelf.all.first().books[0])", 0),
        ("Book.all.first().eClass.findEStructuralFeature('name').name", "name"),
        ("is_kind_of(Book.all.first(), type_of(Book.all.first()))", True),
        ("call(Book.all, 'collect', lambda b: b.pages)", [120, 48, 90]),
        ("Book.all.first().name.join(['a', 'b'])", "aGearsb"),
    ],
)
def test_what_queries_need_stays(expression: str, value: object) -> None:
    assert as_json(evaluate(expression, [EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore", "M")])) == value
