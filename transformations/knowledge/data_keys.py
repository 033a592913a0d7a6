"""The keys that files of the platform repository may have; docs/reference/platform-data.md says what each means.

Here are those of `platform.toml` and `mcus/NAME.toml`; a board's stand in `board_models`, where they are read.
"""

from __future__ import annotations

from robosmi.transformations.knowledge.api_data import PlatformSettings

TARGET = (
    "by_board", "any_board", "generator", "toolchain", "structure", "language", "suffix", "module_suffix", "project_file",
    "libraries",
)  # fmt: skip
"""Keys of the table `[target]`."""
OF_TARGETS = (
    "name", "title", "language", "charSigned", "hasCogs", "intBits", "longBits", "pointerBits", "doubleBits",
    "architecture", "core", "core_name", "include", "pin_functions", "standard_headers", "own_headers", "board_keys",
    "board_architectures", "pin_literals", "target", "widths", "wider_names",
)  # fmt: skip
"""Keys of the `platform.toml` of a platform that programs are moved to."""
OF_SOURCES = tuple(PlatformSettings.__annotations__)
"""Keys of the `platform.toml` of a platform that programs come from; a platform may be both."""
OF_MICROCONTROLLERS = (
    "name", "title", "architecture", "ports", "flash_bytes", "ram_bytes", "signature", "pin_ma", "total_ma", "timers",
    "buses", "takes",
)  # fmt: skip
"""Keys of `mcus/NAME.toml`."""
TAKES = ("functions", "libraries", "parts", "timers", "pins", "buses", "when", "ram_bytes")
"""Keys of an entry `[[takes]]` of a microcontroller."""
