"""The tables of a corpus: what each has, in words, and as SQLAlchemy Core tables.

docs/reference/corpus-schema.md is made from here (`python -m tests.corpus_schema_page`). A change of a table is a new `VERSION`.
"""

from __future__ import annotations

from sqlalchemy import Boolean, Column, Float, ForeignKey, Index, Integer, MetaData, Table, Text

VERSION = 1
"""The version of the tables, stored under the key `schema` of the table `corpus`."""

TABLES = MetaData()


def _column(name: str, kind: type, comment: str, *, key: bool = False) -> Column[object]:
    return Column(name, kind, primary_key=key, nullable=not key, comment=comment)


def _program() -> Column[object]:
    return Column("program", Text, ForeignKey("programs.id"), nullable=False, comment="`programs.id`")


CORPUS = Table(
    "corpus", TABLES,
    _column("key", Text, "`schema` (version of these tables) or `tool` (version of RoboSMi that made the store)", key=True),
    _column("value", Text, "its value"),
    comment="facts about the store itself",
)  # fmt: skip
PROGRAMS = Table(
    "programs", TABLES,
    _column("id", Text, "path from the specification's folder, absolute outside of it; a list names its own", key=True),
    _column("path", Text, "absolute path of the file or folder that was read"),
    _column("repository", Text, "absolute path of the git repository; null for files of a folder"),
    _column("revision", Text, "commit that was read, 40 digits; null for files of a folder"),
    _column("digest", Text, "SHA-256 over all files that the results depend on, headers included"),
    _column("labels", Text, "JSON object: the labels of the entry and of its row in the list"),
    _column("state", Text, "done, failed, timeout, too-large or skipped (not run to its end: a file or tool is missing)"),
    _column("step", Text, "step at which a program that is not done ended"),
    _column("message", Text, "why a program is not done"),
    _column("seconds", Float, "time of all steps"),
    _column("peak_mb", Float, "most memory that a step added to its worker process, or its limit if that was too little, in MiB"),
    _column("settings", Text, "digest of the steps and options that it was run with"),
    _column("limits", Text, "limits that it was run with"),
    _column("tool", Text, "version of RoboSMi, its plug-ins and the user's own data"),
    _column("finished", Text, "time of its end, UTC, ISO 8601"),
    _column("output", Text, "folder of its migration, relative to OUT; null without one"),
    _column("listed", Boolean, "whether the last run's specification still has it"),
    comment="one row for each program",
)  # fmt: skip
FILES = Table(
    "files", TABLES, _program(),
    _column("path", Text, "absolute path"),
    _column("digest", Text, "SHA-256 of the content; empty for a path where a file would count and is none"),
    comment="the files that the results of a program depend on",
)  # fmt: skip
STEPS = Table(
    "steps", TABLES, _program(),
    _column("name", Text, "analyse, migrate, compile or verify"),
    _column("state", Text, "as `programs.state`"),
    _column("seconds", Float, "its time"),
    _column("peak_mb", Float, "most memory that it added to the worker process, as `programs.peak_mb`"),
    _column("message", Text, "why it is not done"),
    comment="the steps of a program that were begun",
)  # fmt: skip
FINDINGS = Table(
    "findings", TABLES, _program(),
    _column("step", Text, "step that reports it"),
    _column("rule", Text, "id of the rule"),
    _column("severity", Text, "error, warning or info"),
    _column("message", Text, "what was found"),
    _column("path", Text, "file"),
    _column("line", Integer, "line, from 1"),
    _column("column", Integer, "column in bytes, from 1"),
    _column("element", Text, "URI of the model element"),
    _column("fix", Text, "what to do"),
    _column("task", Boolean, "whether it is a task that is left to the user"),
    comment="findings and tasks",
)  # fmt: skip
CALLS = Table(
    "calls", TABLES, _program(),
    _column("function", Text, "name of the called function"),
    _column("header", Text, "header that declares it; null if no known one does"),
    _column("line", Integer, "line of the call"),
    _column("path", Text, "file of the call"),
    _column("disposition", Text, "adapt, retain or unsupported after a migration; unknown if nothing declares it; else null"),
    _column(
        "has_body", Boolean,
        "whether an adapter with a body replaces it on the target; null if the platform stays, and before a migration if no "
        "adapter of the function is known",
    ),
    comment="calls of the platform's functions, also through macros, and of functions that nothing known declares",
)  # fmt: skip
PINS = Table(
    "pins", TABLES, _program(),
    _column("pin", Integer, "number on the source; null if known only at run time"),
    _column("expression", Text, "argument as the program writes it"),
    _column("origin", Text, "literal, constant, array, register, runtime or convention"),
    _column("function", Text, "function that is called with it"),
    _column("direction", Text, "in, out, both or unknown"),
    _column("line", Integer, "line of the call"),
    _column("path", Text, "file of the call"),
    comment="uses of pins",
)  # fmt: skip
PLANS = Table(
    "plans", TABLES, _program(),
    _column("target", Text, "board of the plan"),
    *(_column(name, Integer, "elements of the program with this disposition")
      for name in ("retain", "adapt", "drop", "hoist", "rewrite", "unsupported")),
    _column("call_sites", Integer, "calls of the platform's functions"),
    _column("with_body", Integer, "those of them that an adapter with a body replaces"),
    _column("tasks", Integer, "tasks that are left to the user"),
    _column("open_choices", Integer, "choices that nobody has made"),
    _column("report", Text, "the report of the migration, relative to OUT"),
    comment="migration plans",
)  # fmt: skip
COMPILES = Table(
    "compiles", TABLES, _program(),
    _column("target", Text, "board that it was compiled for"),
    _column("ok", Boolean, "whether it compiles and links"),
    _column("fits", Boolean, "whether it fits on the board"),
    _column("flash", Integer, "bytes of flash"),
    _column("ram", Integer, "bytes of RAM"),
    _column("messages", Integer, "messages of the compiler; they are in `findings`"),
    comment="compiled programs",
)  # fmt: skip
VERDICTS = Table(
    "verdicts", TABLES, _program(),
    _column("verdict", Text, "no-difference-found, different, not-decidable or not-compiled"),
    _column("partial", Boolean, "whether a wired output was not compared, or a line not reached"),
    _column("outputs", Integer, "outputs that were compared"),
    _column("outputs_of", Integer, "outputs that are wired"),
    _column("lines_pct", Float, "reached lines of the source, in percent"),
    _column("first_difference", Text, "JSON object of the first difference; null without one"),
    comment="comparisons of original and migrated program",
)  # fmt: skip
MODELS = Table(
    "models", TABLES, _program(),
    _column("kind", Text, "code, hardware, plan or platform"),
    _column("path", Text, "XMI file, relative to OUT"),
    comment="models that were kept",
)  # fmt: skip
DETAILS = (FILES, STEPS, FINDINGS, CALLS, PINS, PLANS, COMPILES, VERDICTS, MODELS)
"""The tables with rows of a program, which a new result of it replaces."""
for _table in DETAILS:
    Index(f"{_table.name}_of_program", _table.c.program)
