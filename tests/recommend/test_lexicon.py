"""The device lexicon: what tables may say, what entries inherit, which devices a part names."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.lexicon import Lexicon
from robosmi.recommend.part_words import Recognised, bus, recognise
from robosmi.recommend.tokens import plain
from robosmi.transformations.knowledge.libraries.library_ranking import device_knowledge

TABLE = Path(__file__).parent / "data" / "devices.csv"


@pytest.fixture
def lexicon() -> Lexicon:
    """Nine devices."""
    return Lexicon([TABLE])


def _names(lexicon: Lexicon, query: ComponentQuery) -> list[str]:
    return [lexicon.devices[found.device].name for found in recognise(lexicon, query)]


def test_need_and_interface_are_inherited(lexicon: Lexicon) -> None:
    chip = lexicon.number_of("BMP180")
    assert chip is not None
    assert (lexicon.devices[chip].need, lexicon.devices[chip].interface, lexicon.devices[chip].depth) == ("library", "i2c", 2)
    assert [lexicon.devices[n].name for n, _ in lexicon.lineage(chip)] == ["BMP180", "barometer", "sensor"]


def test_a_trade_name_an_ending_and_another_spelling_are_one_device(lexicon: Lexicon) -> None:
    for title in ("GY-68", "gy68 module", "BMP180B", "Barometric Pressure Sensor - BMP 180 Breakout (GY-68)"):
        assert _names(lexicon, ComponentQuery("1", title))[0] == "BMP180", title


def test_after_a_beginning_of_letters_only_a_digit_may_follow(lexicon: Lexicon) -> None:
    assert _names(lexicon, ComponentQuery("1", "TSOP312.., 314..")) == ["infrared receiver"]
    assert _names(lexicon, ComponentQuery("1", "TSOPA")) == []


def test_longer_names_and_narrower_kinds_win(lexicon: Lexicon) -> None:
    assert _names(lexicon, ComponentQuery("1", "Vibration Motor"))[0] == "vibration motor"
    assert _names(lexicon, ComponentQuery("1", "Sensor", tags=("barometer",)))[0] == "barometer"


def test_a_title_says_more_than_a_tag(lexicon: Lexicon) -> None:
    assert _names(lexicon, ComponentQuery("1", "Infrared Receiver", tags=("motor",))) == ["infrared receiver", "motor"]


def test_what_a_drawing_numbers_is_recognised(lexicon: Lexicon) -> None:
    assert _names(lexicon, ComponentQuery("1", "Motor12")) == ["motor"]


def test_the_bus_picks_the_variant(lexicon: Lexicon) -> None:
    assert _names(lexicon, ComponentQuery("1", "LCD"))[0] == "LCD"
    assert _names(lexicon, ComponentQuery("1", "LCD", connectors=("GND", "SDA", "SCL")))[0] == "I2C LCD"
    assert _names(lexicon, ComponentQuery("1", "LCM1602 IIC", tags=("LCD",)))[0] == "I2C LCD"


def test_kinds_alone(lexicon: Lexicon) -> None:
    query = ComponentQuery("1", "BMP180 barometer")
    found = recognise(lexicon, query, exact=False)
    assert [(lexicon.devices[f.device].name, f.exact) for f in found] == [("barometer", False)]
    assert recognise(lexicon, ComponentQuery("1", "")) == []
    assert isinstance(found[0], Recognised)


@pytest.mark.parametrize(
    ("connectors", "title", "wanted"),
    [
        (("SDA", "SCL"), "", "i2c"),
        (("D11/MOSI", "SCK"), "", "spi"),
        ((), "Serial LCD", "serial"),
        ((), "I2C/SPI sensor", ""),
        (("OUT",), "Servo", ""),
    ],
)
def test_how_a_part_is_spoken_to(connectors: tuple[str, ...], title: str, wanted: str) -> None:
    assert bus(ComponentQuery("1", title, connectors=connectors)) == wanted


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("names,is\n", "is not a table of devices"),
        ("names,is,need,interface\na,b\n", "this line has 2 columns"),
        ("names,is,need,interface\n|,,,\n", "has no device"),
        ("names,is,need,interface\na,,libary,\n", "'libary' is no need (did you mean 'library'?)"),
        ("names,is,need,interface\na,nothing,,\n", "which is in no table"),
        ('names,is,need,interface\n"a,,,\n', "cannot be read"),
    ],
)
def test_wrong_tables(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(PlatformDataError) as caught:
        Lexicon([path])
    assert message in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_table_in_latin_1_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mine.csv").write_bytes(b"names,is,need,interface\nm\xfchle,,,\n")
    with pytest.raises(PlatformDataError, match="cannot be read"):
        Lexicon([tmp_path / "mine.csv"])


def test_a_ring_of_kinds_ends(tmp_path: Path) -> None:
    (tmp_path / "ring.csv").write_text("names,is,need,interface\na,b,,\nb,a,none,\n", encoding="utf-8")
    lexicon = Lexicon([tmp_path / "ring.csv"])
    assert lexicon.devices[0].need == "none"
    assert len(lexicon.lineage(0)) == 2


def test_one_line_of_ones_own_adds_a_device_or_corrects_one(tmp_path: Path) -> None:
    folder = tmp_path / ".robosmi/platform_repo/parts/devices"
    folder.mkdir(parents=True)
    (folder / "ours.csv").write_text(
        "names,is,need,interface\nRoboSense 9,BMP180,,\nrelay,plain part,library,\n", encoding="utf-8"
    )
    lexicon = device_knowledge("arduino", project=tmp_path).lexicon
    assert lexicon is not None
    own = recognise(lexicon, ComponentQuery("1", "RoboSense-9"))[0]
    assert plain("BMP180") in [plain(lexicon.devices[n].name) for n, _ in lexicon.lineage(own.device)]
    assert lexicon.devices[own.device].need == "library"
    relay = lexicon.number_of("relay")
    assert relay is not None
    assert lexicon.devices[relay].need == "library"


def test_shipped_tables_say_every_name_once_and_know_their_needs() -> None:
    lexicon = device_knowledge("arduino").lexicon
    assert lexicon is not None
    names = [plain(n) + "*" * n.endswith("*") for device in lexicon.devices for n in device.names]
    assert sorted({name for name in names if names.count(name) > 1}) == []
    top = {device.name for device in lexicon.devices if not device.need}
    assert top == {"component"}


def test_usual_libraries_are_libraries_of_the_index_and_devices_of_the_tables() -> None:
    from robosmi.transformations.knowledge.libraries.library_ranking import library_index

    knowledge, known = device_knowledge("arduino"), set(library_index().names())
    assert knowledge.lexicon is not None
    assert [device for device in knowledge.usual if knowledge.lexicon.number_of(device) is None] == []
    assert sorted({name for names in knowledge.usual.values() for name in names if name not in known}) == []
