"""No adapter outside the hardware layer names a register, an interrupt or an instruction of a processor.

Words of AVR microcontrollers are listed here as their data sheets, avr-libc and the core spell them.
"""

from __future__ import annotations

import re

import pytest

from robosmi.transformations.knowledge.adapters.adapter_files import HAL
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.lexer import tokens
from tests.adapters.bench import pieces

OF_A_PROCESSOR = re.compile(
    r"SREG|cli|sei|ISR|ISR_\w+|_?SP[LH]?|_BV|_SFR_\w+|F_CPU|clockCyclesPerMicrosecond"
    r"|(?:TCCR|TCNT|OCR|ICR|TIMSK|TIFR)\d\w*|(?:WGM|COM|CS)\d\d|(?:OCIE|OCF|TOIE|TOV)\d\w?|\w+_vect"
    r"|(?:PIN|PORT|DDR)[A-L]|port\w+Register|digitalPinTo(?:Port|BitMask|Timer|PC\w+)"
    r"|PC(?:ICR|IFR|MSK)\d?|E(?:IMSK|ICRA|IFR)|TW[A-Z]{2,3}|UCSR\d\w|UBRR\d\w?|UDR\d|SP[CSD]R"
    r"|ADMUX|ADCSR[AB]|ADC[HLW]|eeprom_\w+|E2END|__malloc_\w+|__heap_start|__brkval|RAMEND|__AVR\w*"
    r"|_delay_\w+|__builtin_avr_\w+|fdev_\w+|_FDEV_\w+|timer0_\w+"
)
BARRIER = re.compile(r'asm (?:volatile )?\( "" ')
"""An empty instruction, which only says what the compiler may not assume."""
PORT_POINTER = re.compile(r"volatile uint8_t \*")


def named(piece: AdapterPiece) -> list[str]:
    """What of a processor a piece names in its text, its includes and its markers."""
    found = [text for kind, *_, text in tokens(piece.text.encode()) if kind not in ("comment", "space")]
    spelled = " ".join(found)
    words = [word for text in found for word in re.findall(r"\w+", text) if OF_A_PROCESSOR.fullmatch(word)]
    words += ["asm"] * (len(re.findall(r"\b(?:__)?asm(?:__)?\b", spelled)) - len(BARRIER.findall(spelled)))
    words += PORT_POINTER.findall(spelled)
    words += [header for header in piece.includes if re.match("<(?:avr|util)/", header)]
    return [*words, *piece.timers, *piece.vectors, *piece.taken, *piece.mcus]


def test_only_the_hardware_layer_names_a_processor() -> None:
    outside = [piece for piece in pieces() if piece.header != HAL]
    assert {f"{piece.header}/{piece.name}": words for piece in outside if (words := named(piece))} == {}


def test_pieces_of_the_layer_for_no_architecture_name_no_processor() -> None:
    layer = [piece for piece in pieces() if piece.header == HAL]
    own = {"avr", "rp2040"}
    assert [piece.name for piece in layer if own.isdisjoint(piece.architectures) and named(piece)] == []
    assert len({piece.name for piece in layer if not piece.architectures}) > 25
    assert any(named(piece) for piece in layer if piece.architectures == ["avr"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("uint8_t old = SREG; cli();", ["SREG", "cli"]),
        ("volatile uint8_t *in;", ["volatile uint8_t *"]),
        ("ISR(TIMER1_COMPA_vect) {}", ["ISR", "TIMER1_COMPA_vect"]),
        ('asm("nop");', ["asm"]),
        ('asm volatile("" : "+m"(held_up));  // SREG\n', []),
        ("Uninterrupted now; analogRead(A0);", []),
    ],
)
def test_words_of_a_processor_are_seen(text: str, words: list[str]) -> None:
    piece = pieces()[0]
    assert named(AdapterPiece("helper", "x", "x.h", piece.location, text)) == words
