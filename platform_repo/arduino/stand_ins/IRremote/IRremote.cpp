// NEC: a mark of 9 ms, a space of 4.5 ms (2.25 ms: the last frame again), 32 bits of a mark of 560 us and a space of 560 us (0) or
// 1690 us (1), lowest bit first, and a last mark. Sent are address, its complement, command, its complement. A receiver gives a low
// level for a mark. The line is looked at every 50 us.
#include "IRremote.hpp"

IRrecv IrReceiver;
IRsend IrSender;

namespace {

const uint16_t LONGEST = 400;  // ticks of 50 us

volatile uint8_t *line;
uint8_t lineBit;
bool lastLevel = true;
uint16_t ticks;
uint16_t lastMark;
int8_t bits = -1;  // received so far; -1: waiting for the mark that begins a frame
uint32_t value;
volatile uint32_t received;
volatile bool ready;
volatile bool repeated;

bool about(uint16_t measured, uint16_t microseconds) {
  const uint16_t wanted = microseconds / 50;
  return measured + wanted / 4 + 2 >= wanted && measured <= wanted + wanted / 4 + 2;
}

void ended(bool wasMark, uint16_t length) {
  if (wasMark) {
    lastMark = length;
    if (bits == 32) {
      received = value;
      repeated = false;
      ready = true;
      bits = -1;
    }
    return;
  }
  if (about(lastMark, 9000)) {
    if (about(length, 4500)) {
      bits = 0;
      value = 0;
    } else if (about(length, 2250) && received != 0) {
      repeated = true;
      ready = true;
    }
  } else if (bits >= 0 && bits < 32 && about(lastMark, 560) && (about(length, 560) || about(length, 1690))) {
    value = value >> 1 | (about(length, 1690) ? 0x80000000UL : 0);
    bits++;
  } else {
    bits = -1;
  }
}

}  // namespace

#ifdef TCCR2A
ISR(TIMER2_COMPA_vect) {
#else  // the ATmega32U4 has no timer 2
ISR(TIMER3_COMPA_vect) {
#endif
  const bool level = *line & lineBit;
  if (level == lastLevel) {
    if (ticks < LONGEST) ticks++;
    return;
  }
  if (!ready) ended(!lastLevel, ticks);
  lastLevel = level;
  ticks = 1;
}

IRrecv::IRrecv() : decodedIRData(), pin(2) {}

IRrecv::IRrecv(uint8_t pin) : decodedIRData(), pin(pin) {}

void IRrecv::begin(uint8_t newPin, bool feedback, uint8_t feedbackPin) {
  (void)feedback;
  (void)feedbackPin;
  pin = newPin;
  enableIRIn();
}

void IRrecv::enableIRIn() {
  pinMode(pin, INPUT);
  line = portInputRegister(digitalPinToPort(pin));
  lineBit = digitalPinToBitMask(pin);
  const uint8_t status = SREG;
  cli();
#ifdef TCCR2A
  TCCR2A = _BV(WGM21);  // counts to OCR2A
  TCCR2B = _BV(CS21);   // every 8 cycles
  OCR2A = F_CPU / 8 / 20000 - 1;
  TCNT2 = 0;
  TIMSK2 = _BV(OCIE2A);
#else
  TCCR3A = 0;
  TCCR3B = _BV(WGM32) | _BV(CS31);
  OCR3A = F_CPU / 8 / 20000 - 1;
  TCNT3 = 0;
  TIMSK3 = _BV(OCIE3A);
#endif
  SREG = status;
  resume();
}

void IRrecv::disableIRIn() {
#ifdef TCCR2A
  TIMSK2 = 0;
#else
  TIMSK3 = 0;
#endif
}

bool IRrecv::decode() {
  if (!ready) return false;
  decodedIRData.protocol = NEC;
  decodedIRData.decodedRawData = received;
  const uint16_t address = received & 0xFFFF;
  const bool plain = ((address >> 8) ^ (address & 0xFF)) == 0xFF;  // else all 16 bits are address
  decodedIRData.address = plain ? address & 0xFF : address;
  decodedIRData.command = received >> 16 & 0xFF;
  decodedIRData.extra = 0;
  decodedIRData.numberOfBits = repeated ? 0 : 32;
  decodedIRData.flags = repeated ? IRDATA_FLAGS_IS_REPEAT : IRDATA_FLAGS_EMPTY;
  return true;
}

void IRrecv::resume() { ready = false; }

bool IRrecv::isIdle() { return bits < 0; }

bool IRrecv::printIRResultShort(Print *out) {
  out->print(F("Protocol=NEC Address=0x"));
  out->print(decodedIRData.address, HEX);
  out->print(F(" Command=0x"));
  out->println(decodedIRData.command, HEX);
  return true;
}

IRsend::IRsend() : pin(3) {}

IRsend::IRsend(uint8_t pin) : pin(pin) {}

void IRsend::begin(uint8_t newPin) {
  pin = newPin;
  pinMode(pin, OUTPUT);
}

void IRsend::mark(uint16_t microseconds) {
  volatile uint8_t *out = portOutputRegister(digitalPinToPort(pin));
  const uint8_t bit = digitalPinToBitMask(pin);
  for (uint16_t left = microseconds / 26; left > 0; left--) {
    *out |= bit;
    delayMicroseconds(9);
    *out &= static_cast<uint8_t>(~bit);
    delayMicroseconds(15);
  }
}

void IRsend::space(uint16_t microseconds) { delayMicroseconds(microseconds); }

void IRsend::sendNEC(uint16_t address, uint16_t command, int_fast8_t repeats) {
  const uint16_t both = address > 0xFF ? address : address | static_cast<uint16_t>((~address & 0xFF) << 8);
  const uint32_t frame = both | static_cast<uint32_t>(command & 0xFF) << 16 | static_cast<uint32_t>(~command & 0xFF) << 24;
  mark(9000);
  space(4500);
  for (uint8_t i = 0; i < 32; i++) {
    mark(560);
    space(frame >> i & 1 ? 1690 : 560);
  }
  mark(560);
  for (; repeats > 0; repeats--) {
    delay(96);
    mark(9000);
    space(2250);
    mark(560);
  }
}
