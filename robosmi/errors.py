"""Every error that the framework raises on purpose, and the exit code it stands for.

One root, `RobosmiError`, which is never raised itself. The leaves say whose fault it is: the arguments, the user's
file, an entry of the platform repository, a tool that is not there, or our own code. An error knows the place, the
cause and what to do next; its text is `path:line:column: cause` with the next step on a line of its own. Nothing here
knows a platform, a board or a drawing tool.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from robosmi.diagnostics import Location


class RobosmiError(Exception):
    """Root of all errors of this package.

    Args:
        message: the cause, one sentence without a full stop.
        location: where, or None if it has no place in a file.
        fix: what to do next, one sentence; None if there is nothing to advise.
    """

    exit_code = 70

    def __init__(self, message: str, *, location: Location | None = None, fix: str | None = None) -> None:
        if self.__class__ is RobosmiError:
            raise TypeError("RobosmiError is abstract: raise one of its leaves")
        super().__init__(message)
        self.message = message
        self.location = location
        self.fix = fix

    def __str__(self) -> str:
        place = f"{self.location}: " if self.location else ""
        advice = f"\n  do: {self.fix}" if self.fix else ""
        return f"{place}{self.message}{advice}"


class UsageError(RobosmiError):
    """The arguments are wrong: unknown option value, ambiguous name, contradiction (exit code 2)."""

    exit_code = 2


class SourceError(RobosmiError):
    """A file of the user's cannot be read, or cannot be used by this command (exit code 3)."""

    exit_code = 3


class TooLargeError(SourceError):
    """An input has more of something (calls, parts, tokens) than RoboSMi reads in reasonable time (exit code 3)."""


class RuleError(SourceError):
    """A constraint, rule or template of the user's is wrong or raises; the place is its own file and line (exit code 3)."""


class PlatformDataError(RobosmiError):
    """An entry of the platform repository is damaged or contradicts another (exit code 3)."""

    exit_code = 3


class ModelError(RobosmiError):
    """A model or metamodel is used against its definition: unknown feature, wrong value, dangling reference (exit code 3)."""

    exit_code = 3


class MissingToolError(RobosmiError):
    """A program that the command needs is not installed (exit code 4)."""

    exit_code = 4


class StoppedError(RobosmiError):
    """Generation stopped: an open choice under `--strict`, or the user's edit that would be lost (exit code 5)."""

    exit_code = 5


class ChangedMeanwhileError(StoppedError):
    """A file that a run has read, and would replace, was changed while the run was at work: by another run, or by the user."""


class CompileError(RobosmiError):
    """The generated program does not compile or link (exit code 6)."""

    exit_code = 6


class UploadError(RobosmiError):
    """A board did not take a program: it is not there, is another one, or does not answer (exit code 6)."""

    exit_code = 6


class VerificationError(RobosmiError):
    """A program cannot be run on a simulator, or the run does not end (exit code 6)."""

    exit_code = 6


class EngineCrashError(VerificationError):
    """A simulator itself ended without telling what the program did (exit code 6): another one may do it."""


class TimeLimitError(VerificationError):
    """A run was given up at its time limit (exit code 6)."""


class InternalError(RobosmiError):
    """Our own bug (exit code 70)."""

    exit_code = 70


def did_you_mean(word: str, known: Iterable[str], least: float = 0.6) -> str:
    """The closest of the known words as ` (did you mean 'x'?)`, or an empty text when none is close.

    Args:
        word: what was written.
        known: an iterable of the words that exist.
        least: how similar it must be, up to 1.
    """
    import difflib  # 4 ms, wanted only when something is wrong

    close = difflib.get_close_matches(word, list(known), n=1, cutoff=least)
    return f" (did you mean '{close[0]}'?)" if close else ""


def some_of(known: Iterable[str], word: str, most: int = 20) -> str:
    """The known words for a message; of more than `most` those that are nearest to a word, and how many others there are.

    >>> some_of(["Cat", "Bat", "Dog"], "Cab", 2)
    'Cat, and 2 more'
    """
    names = sorted(set(known))
    if len(names) <= most:
        return ", ".join(names)
    import difflib  # as above

    near = difflib.get_close_matches(word, names, n=5) or names[:most]
    return f"{', '.join(near)}, and {len(names) - len(near):,} more"


@contextmanager
def placed(place: Location | None, advice: str = "") -> Iterator[None]:
    """Context manager: add a location, such as a settings file, to usage errors without one.

    Args:
        place: the place; None changes nothing.
        advice: what can be done there, which goes before the error's own advice.
    """
    try:
        yield
    except UsageError as error:
        if place is not None and error.location is None:
            error.location = place
            error.fix = "; ".join(each for each in (advice, error.fix) if each) or None
        raise
