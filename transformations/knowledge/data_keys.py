"""The keys allowed in files of the platform repository; docs/reference/platform-data.md explains them.

These are the keys of `platform.toml` and `mcus/NAME.toml`; those of boards are in `board_models`, which reads them.
"""

from __future__ import annotations

from robosmi.transformations.knowledge.api_data import PlatformSettings

TARGET = (
    "by_board", "any_board", "generator", "toolchain", "structure", "language", "suffix", "module_suffix", "project_file",
    "libraries",
)  # fmt: skip
"""Keys of the table `[target]`."""
OF_TARGETS = (
    "name", "title", "language", "charSigned", "losesLevel", "hasCogs", "intBits", "longBits", "pointerBits", "doubleBits",
    "architecture", "core", "core_name", "include", "pin_functions", "standard_headers", "own_headers", "board_keys",
    "board_architectures", "pin_literals", "target", "widths", "wider_names", "cores", "architectures",
)  # fmt: skip
"""Keys in the `platform.toml` of a target platform."""
OF_ARCHITECTURES = ("losesLevel", "charSigned", "intBits", "longBits", "pointerBits", "doubleBits", "widths", "wider_names")
"""Keys of a table `[architectures.NAME]` of a target platform."""
OF_SOURCES = tuple(PlatformSettings.__annotations__)
"""Keys in the `platform.toml` of a source platform; a platform may be both."""
OF_MICROCONTROLLERS = (
    "name", "title", "architecture", "ports", "flash_bytes", "ram_bytes", "signature", "pin_ma", "total_ma", "timers",
    "buses", "takes", "shared_channels", "pin_volts",
)  # fmt: skip
"""Keys of `mcus/NAME.toml`."""
OF_CORES = ("index_url", "platformio", "platformio_settings", "numbers_by_port")
"""Keys of a table `[cores.NAME]` of a target platform."""
TAKES = ("functions", "libraries", "parts", "timers", "pins", "buses", "when", "ram_bytes")
"""Keys of an entry `[[takes]]` of a microcontroller."""
