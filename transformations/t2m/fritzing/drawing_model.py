"""The drawing in a `.fzz` as a model of plain XML, to be queried without conversion: `t_instance.all.a_moduleIdRef`.

It is a `Model` like any other of `robosmi.model.plain_xml`, read in memory and within the limits of `container`. When it is
saved, the archive keeps its other entries. `reader` knows what the elements mean.
"""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.files import zip_archive
from robosmi.files.files import write_atomic
from robosmi.model.plain_xml import XmlModel

from .container import MAX_BYTES, MAX_ENTRIES, read_container


class DrawingModel(XmlModel):
    """A drawing with the archive around it.

    Attributes:
        archive: its bytes.
        sketch_name: the name of the drawing in it.
    """

    archive = b""
    sketch_name = ""

    def save(self, path: str | Path | None = None) -> None:
        """Write the drawing: into a copy of its archive, or as XML if the path does not end in `.fzz`; see `Model.save`."""
        target = self._target(path)
        text = self.to_bytes()
        in_archive = self.archive and target.suffix.lower() == ".fzz"
        write_atomic(target, self._with(text) if in_archive else text)

    def _with(self, text: bytes) -> bytes:
        """The archive with another drawing in it; the same bytes if that is the same."""
        out = io.BytesIO()
        room = MAX_BYTES
        place = str(self.path)
        try:
            with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as new:
                for entry in zip_archive.entries(self.archive, place, MAX_ENTRIES):
                    content = zip_archive.unpacked(self.archive, entry, place, room)
                    room -= len(content)
                    if entry.filename == self.sketch_name:
                        if content == text:
                            return self.archive
                        content = text
                    new.writestr(entry, content)
        except zipfile.BadZipFile as error:
            cause = f"the archive cannot be copied: {error}"
            raise SourceError(cause, location=Location(place), fix="save the drawing as .fz instead") from error
        return out.getvalue()


def open_drawing(path: Path, name: str | None = None) -> DrawingModel:
    """Open a `.fzz` file.

    Raises:
        SourceError: it is no archive with a drawing in it, or that is no well-formed XML.
    """
    held = read_container(path)
    model = DrawingModel.parse(held.sketch, name or path.stem, path)
    data = inputs.read_bytes(path, inputs.DRAWING)
    model.archive, model.sketch_name = data if data[:2] == b"PK" else b"", held.sketch_name
    return model
