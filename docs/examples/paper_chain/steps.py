"""The paper's steps: queries on the models of a program and a drawing fill a model from which a template generates the sketch."""

import csv
from pathlib import Path

from robosmi import load_hardware
from robosmi.model.emf import EmfModel
from robosmi.transformations.knowledge.board_models import load_board, load_mapping
from robosmi.transformations.knowledge.libraries.library_ranking import tfidf_ranker
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.m2m.choices.library_choice import component_query
from robosmi.transformations.m2m.circuits.connector_mapping import map_connectors
from robosmi.transformations.queries.circuits.circuit import component_named, port_interfaces
from robosmi.transformations.queries.code import platform_agnostic_libraries, platform_dependent_constructs
from robosmi.transformations.queries.programs.main_program import main_structure
from robosmi.validate import Fail

SELECTED = Path(__file__).with_name("libraries.csv")


def drawing(path, name):
    """The driver of drawings: text to model (3.2)."""
    return EmfModel(load_hardware(path), name=name, path=Path(path))


def signature(function):
    """The raw signature of a function; a macro such as `waitcnt` has none, so its parameters follow from its first call."""
    if not function.signature.startswith(f"{function.name}("):
        return function.signature
    return f"void {function.name}({', '.join(f'int a{n}' for n, _ in enumerate(function.calls[0].arguments))})"


def to_sketch(t, program, circuit, sketch):
    """What the template of Listing 2 asks for: constructs (3.1), ports by Algorithm 1 (3.2), ranked libraries (3.3)."""
    api = ApiIndex.load("propeller")

    @t.rule
    def Unit2Sketch(unit: program.SourceUnit, s: sketch.Sketch):
        root, source, main = unit.eContainer(), Path(unit.path).read_bytes(), main_structure(unit)

        def text(element):
            end = ";" * (element.eClass.name == "Variable")
            return source[element.startOffset : element.endOffset].decode() + end

        s.name = Path(unit.path).stem
        s.agnosticLibraries.extend(include.header for include in platform_agnostic_libraries(root, api))
        s.placeholders.extend(map(signature, platform_dependent_constructs(root, api).functions))
        s.kept.extend(text(declaration) for declaration in unit.declarations if declaration is not main.function)
        s.setup.extend(map(text, main.before))
        s.loop.extend(map(text, main.loop.body.statements if main.loop else ()))

    @t.post
    def ports_and_libraries():
        s, drawn = sketch.Sketch.all[0], circuit.Circuit.all[0]
        connections, _ = map_connectors(drawn)
        for name, pin in port_interfaces(connections, load_mapping("arduino", load_board("uno"))).items():
            s.ports.append(sketch.Port(name=name, pin=pin))
        with SELECTED.open(encoding="utf-8", newline="") as rows:
            for row in csv.DictReader(rows):
                ranked = tfidf_ranker().rank(component_query(component_named(drawn, row["component"]))).candidates
                found = [(number, c.header) for number, c in enumerate(ranked, 1) if c.library == row["library"]]
                rank, header = found[0] if found else (0, "")
                s.libraries.append(sketch.Library(component=row["component"], name=row["library"], rank=rank, header=header))


def constraints(v, sketch):
    """A selected library is one of the ranked ones (Figure 5)."""

    @v.context(sketch.Library).constraint
    def IsCandidate(library):
        return library.rank > 0 or Fail(f"'{library.name}' is no candidate for '{library.component}'", fix="select another one")


def pages(g, sketch):
    """Model to text (3.4)."""

    @g.rule(sketch.Sketch, template="sketch.ino", target=lambda s: f"{s.name}/{s.name}.ino")
    def Sketch(s):
        return {"headers": sorted({library.header for library in s.libraries})}
