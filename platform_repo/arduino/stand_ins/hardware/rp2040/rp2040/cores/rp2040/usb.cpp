// The console: a serial device (CDC ACM) on USB. As with the real core, what is written before a program on the PC has opened it is lost.
// Sources: RP2040 data sheet, "USB"; USB 2.0, chapter 9; USB CDC 1.2 and its PSTN devices.
#include <Arduino.h>
#include <hardware/irq.h>
#include <hardware/sync.h>

#include "registers.h"

namespace {

constexpr uint32_t MEMORY = 0x50100000, CONTROLLER = 0x50110000;
constexpr uint32_t ADDRESS = CONTROLLER, MAIN = CONTROLLER + 0x40, ENGINE = CONTROLLER + 0x4c, STATUS = CONTROLLER + 0x50,
                   BUFFERS = CONTROLLER + 0x58, MUXING = CONTROLLER + 0x74, POWER = CONTROLLER + 0x78, ENABLED = CONTROLLER + 0x90,
                   RAISED = CONTROLLER + 0x98;
constexpr uint32_t FULL = 1 << 15, SECOND_PID = 1 << 13, AVAILABLE = 1 << 10, LENGTH = 0x3ff;
constexpr uint32_t BUS_RESET = 1 << 12, SETUP = 1 << 16, BUFFER_DONE = 1 << 4, RESET_SEEN = 1 << 19, SETUP_SEEN = 1 << 17, PULL_UP = 1 << 16;
constexpr uint32_t PACKET = 64, NOTICES = 1, DATA = 2;
constexpr uint32_t CONTROL_BUFFER = 0x100, IN_BUFFER = 0x180, OUT_BUFFER = 0x1c0, NOTICE_BUFFER = 0x200;
enum Request : uint8_t { SET_ADDRESS = 5, GET_DESCRIPTOR = 6, SET_CONFIGURATION = 9, SET_LINE_CODING = 0x20, GET_LINE_CODING, SET_LINE_STATE };
enum Descriptor : uint8_t { DEVICE = 1, CONFIGURATION, TEXT, INTERFACE, ENDPOINT, ASSOCIATION = 11, OF_INTERFACE = 0x24 };

constexpr uint8_t DEVICE_DESCRIPTOR[] = {18, DEVICE, 0, 2, 0xef, 2, 1, PACKET, 0x8a, 0x2e, 0x0a, 0, 0, 1, 0, 0, 0, 1};
constexpr uint8_t CONFIGURATION_DESCRIPTOR[] = {
    9, CONFIGURATION, 75, 0, 2, 1, 0, 0x80, 125,
    8, ASSOCIATION, 0, 2, 2, 2, 0, 0,
    9, INTERFACE, 0, 0, 1, 2, 2, 0, 0,
    5, OF_INTERFACE, 0, 0x20, 1,
    5, OF_INTERFACE, 1, 0, 1,
    4, OF_INTERFACE, 2, 2,
    5, OF_INTERFACE, 6, 0, 1,
    7, ENDPOINT, 0x80 | NOTICES, 3, 8, 0, 16,
    9, INTERFACE, 1, 0, 2, 10, 0, 0, 0,
    7, ENDPOINT, DATA, 2, PACKET, 0, 0,
    7, ENDPOINT, 0x80 | DATA, 2, PACKET, 0, 0,
};
static_assert(sizeof CONFIGURATION_DESCRIPTOR == 75);

template <uint32_t size> class Ring {
 public:
  uint32_t count() const { return last - first; }
  bool full() const { return count() == size; }
  void put(uint8_t byte) { bytes[last % size] = byte, last = last + 1; }
  uint8_t peek() const { return bytes[first % size]; }
  uint8_t take() {
    uint8_t byte = peek();
    first = first + 1;
    return byte;
  }
  uint32_t room() const { return size - count(); }

 private:
  uint8_t bytes[size];
  volatile uint32_t first = 0, last = 0;
};

Ring<1024> sent, received;
bool configured, opened, sending, listening, secondIn, secondOut, secondControl;
uint8_t addressToTake, lineCoding[7] = {0, 0xc2, 1, 0, 0, 0, 8};
const uint8_t *answer;
uint32_t answerLeft;

volatile uint8_t *memory(uint32_t at) { return (volatile uint8_t *)(MEMORY + at); }
volatile uint32_t &buffer(uint32_t endpoint, bool out) { return reg(MEMORY + 0x80 + 8 * endpoint + (out ? 4 : 0)); }
void endpointControl(uint32_t endpoint, bool out, uint32_t kind, uint32_t at) {
  reg(MEMORY + 8 * endpoint + (out ? 4 : 0)) = 1u << 31 | 1u << 29 | kind << 26 | at;
}

void start(uint32_t endpoint, bool out, uint32_t length, bool &second) {
  uint32_t value = length | (second ? SECOND_PID : 0) | (out ? 0 : FULL);
  second = !second;
  buffer(endpoint, out) = value;
  buffer(endpoint, out) = value | AVAILABLE;
}

void sendControl() {
  uint32_t length = min(answerLeft, PACKET);
  for (uint32_t at = 0; at < length; at++) memory(CONTROL_BUFFER)[at] = answer[at];
  answer += length;
  answerLeft -= length;
  start(0, false, length, secondControl);
}

void reply(const uint8_t *bytes, uint32_t length, uint32_t asked) {
  answer = bytes;
  answerLeft = min(length, asked);
  sendControl();
}

void acknowledge() { reply(nullptr, 0, 0); }

void sendMore() {
  if (sending || !sent.count()) return;
  uint32_t length = min(sent.count(), PACKET);
  for (uint32_t at = 0; at < length; at++) memory(IN_BUFFER)[at] = sent.take();
  sending = true;
  start(DATA, false, length, secondIn);
}

void listenMore() {
  if (listening || !configured || received.room() < PACKET) return;
  listening = true;
  start(DATA, true, PACKET, secondOut);
}

void setUp() {
  uint8_t packet[8];
  for (int at = 0; at < 8; at++) packet[at] = memory(0)[at];
  uint32_t value = packet[2] | packet[3] << 8, length = packet[6] | packet[7] << 8;
  secondControl = true;  // a reply begins with the second PID
  switch (packet[1]) {
    case SET_ADDRESS:
      addressToTake = value;
      break;
    case GET_DESCRIPTOR:
      if (packet[3] == DEVICE) return reply(DEVICE_DESCRIPTOR, sizeof DEVICE_DESCRIPTOR, length);
      if (packet[3] == CONFIGURATION) return reply(CONFIGURATION_DESCRIPTOR, sizeof CONFIGURATION_DESCRIPTOR, length);
      break;
    case GET_LINE_CODING:
      return reply(lineCoding, sizeof lineCoding, length);
    case SET_LINE_CODING:
      return start(0, true, sizeof lineCoding, secondControl);
    case SET_CONFIGURATION:
      endpointControl(NOTICES, false, 3, NOTICE_BUFFER);
      endpointControl(DATA, false, 2, IN_BUFFER);
      endpointControl(DATA, true, 2, OUT_BUFFER);
      configured = true;
      listenMore();
      break;
    case SET_LINE_STATE:
      opened = value & 1;
      break;
  }
  acknowledge();
}

void buffersDone() {
  uint32_t done = reg(BUFFERS);
  reg(BUFFERS) = done;
  if (done & 1) {
    if (addressToTake) reg(ADDRESS) = addressToTake;
    addressToTake = 0;
    if (answerLeft) sendControl();
  }
  if (done & 2 && (buffer(0, true) & LENGTH) == sizeof lineCoding) {
    for (uint32_t at = 0; at < sizeof lineCoding; at++) lineCoding[at] = memory(CONTROL_BUFFER)[at];
    secondControl = true;
    acknowledge();
  }
  if (done >> 2 * DATA & 1) {
    sending = false;
    sendMore();
  }
  if (done >> (2 * DATA + 1) & 1) {
    uint32_t length = buffer(DATA, true) & LENGTH;
    for (uint32_t at = 0; at < length; at++) received.put(memory(OUT_BUFFER)[at]);
    listening = false;
    listenMore();
  }
}

void raised() {
  uint32_t why = reg(RAISED);
  if (why & BUS_RESET) {
    reg(STATUS) = RESET_SEEN;
    reg(ADDRESS) = 0;
    configured = opened = sending = listening = secondIn = secondOut = false;
  }
  if (why & SETUP) {
    reg(STATUS) = SETUP_SEEN;
    setUp();
  }
  if (why & BUFFER_DONE) buffersDone();
}

}  // namespace

extern "C" void __start_usb() {
  reg(CLOCKS + 0x54) = 1 << 11;  // 48 MHz of its PLL
  clearBits(RESETS, 1 << 24);
  while (!(reg(RESETS + 8) >> 24 & 1)) {}
  for (uint32_t at = 0; at < 0x200; at += 4) reg(MEMORY + at) = 0;
  reg(MUXING) = 9;   // to its pins, connected by software
  reg(POWER) = 12;   // as if the supply were seen
  irq_set_exclusive_handler(USBCTRL_IRQ, raised);
  irq_set_enabled(USBCTRL_IRQ, true);
  reg(MAIN) = 1;
  reg(ENGINE) = 1 << 29;  // an interrupt for each buffer of endpoint 0
  reg(ENABLED) = BUFFER_DONE | BUS_RESET | SETUP;
  setBits(ENGINE, PULL_UP);
}

SerialUSB Serial;

void SerialUSB::begin(unsigned long) {}
SerialUSB::operator bool() { return configured && opened; }
int SerialUSB::available() { return received.count(); }
int SerialUSB::peek() { return received.count() ? received.peek() : -1; }
int SerialUSB::read() {
  if (!received.count()) return -1;
  uint8_t byte = received.take();
  uint32_t state = save_and_disable_interrupts();
  listenMore();
  restore_interrupts(state);
  return byte;
}

size_t SerialUSB::write(const uint8_t *bytes, size_t count) {
  size_t written = 0;
  for (unsigned long begun = millis(); *this && written < count;) {
    uint32_t state = save_and_disable_interrupts();
    if (sent.full() && state) buffersDone();  // interrupts were off before: nobody else makes room
    for (; written < count && !sent.full(); written++) sent.put(bytes[written]);
    sendMore();
    restore_interrupts(state);
    if (millis() - begun > 500) break;  // nobody reads
  }
  return written;
}
size_t SerialUSB::write(uint8_t byte) { return write(&byte, 1); }
int SerialUSB::availableForWrite() { return sent.room(); }
void SerialUSB::flush() {
  for (unsigned long begun = millis(); *this && (sent.count() || sending) && millis() - begun < 500;) {}
}

void serialEvent() __attribute__((weak));  // the sketch's, for text that has come

void serialEventRun() {
  if (serialEvent && Serial.available()) serialEvent();
}
