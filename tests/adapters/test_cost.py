"""No call of an adapter whose pin the compiler knows costs much more than plain Arduino code, and the pins that it knows are right."""

from __future__ import annotations

import re

from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.verify.toolchains.boards import load_boards
from robosmi.verify.toolchains.toolchain_data import load_toolchain
from tests.adapters import bench, cost
from tests.tools import require_engine, require_tools
