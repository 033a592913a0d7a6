// Each servo is a state machine of a PIO block, which makes frames by itself and takes a new width at the begin of one.
#include "Servo.h"

#include <hardware/gpio.h>
#include <registers.h>

namespace {

constexpr uint32_t PIO[2] = {0x50200000, 0x50300000};
constexpr uint32_t CONTROL = 0, QUEUE = 0x10, MEMORY = 0x48, FIRST_MACHINE = 0xc8, PER_MACHINE = 0x18;
constexpr uint32_t CLOCK = 0, WRAP = 4, SHIFT = 8, ADDRESS = 12, EXECUTE = 16, PINS = 20;
constexpr uint32_t SHIFT_RIGHT = 1 << 19, JOINED = 1u << 31, ONE_PIN = 1 << 26, PIN_IS_OUTPUT = 0xe081;
constexpr uint32_t FIRST = 24, REST = FIRST + 7;
// One instruction takes a microsecond. A word has the width in its lower half and the rest of the frame in its upper one.
constexpr uint16_t PROGRAM[] = {
    0x8080,                 // pull noblock: what is in x where the queue is empty
    0xa027,                 // mov x, osr
    0x6050,                 // out y, 16
    0xe001,                 // set pins, 1
    0x0080 | (FIRST + 4),   // jmp y--, itself
    0xe000,                 // set pins, 0
    0x6050,                 // out y, 16
    0x0080 | REST,          // jmp y--, itself
};
constexpr int HIGH_BESIDE = 2, LOW_BESIDE = 6;  // microseconds that the other instructions take
int8_t pinOf[MAX_SERVOS] = {-1, -1, -1, -1, -1, -1, -1, -1};

uint32_t block(int place) { return PIO[place / 4]; }
uint32_t machine(int place) { return block(place) + FIRST_MACHINE + PER_MACHINE * (place % 4); }
void send(int place, int width) {  // the next frame has the last width: those before it leave the queue
  reg(machine(place) + SHIFT) = SHIFT_RIGHT | JOINED;
  reg(machine(place) + SHIFT) = SHIFT_RIGHT;
  reg(block(place) + QUEUE + 4 * (place % 4)) = (uint32_t)(REFRESH_INTERVAL - width - LOW_BESIDE) << 16 | (width - HIGH_BESIDE);
}

}  // namespace

uint8_t Servo::attach(pin_size_t pin, int min, int max, int value) {
  detach();
  int free = 0;
  while (free < MAX_SERVOS && pinOf[free] >= 0) free++;
  if (free == MAX_SERVOS || pin >= NUM_DIGITAL_PINS) return INVALID_SERVO;
  lowest = min;
  highest = max;
  pinOf[place = free] = pin;
  uint32_t own = machine(place);
  for (uint32_t at = 0; at < sizeof PROGRAM / sizeof *PROGRAM; at++) reg(block(place) + MEMORY + 4 * (FIRST + at)) = PROGRAM[at];
  reg(own + CLOCK) = F_CPU / 1000000 << 16;
  reg(own + WRAP) = REST << 12 | FIRST << 7;
  reg(own + SHIFT) = SHIFT_RIGHT;
  reg(own + PINS) = ONE_PIN | (uint32_t)pin << 5;
  reg(own + EXECUTE) = PIN_IS_OUTPUT;
  reg(own + EXECUTE) = FIRST;  // jmp
  gpio_set_function(pin, place < 4 ? GPIO_FUNC_PIO0 : GPIO_FUNC_PIO1);
  write(value);
  setBits(block(place) + CONTROL, 1u << (place % 4));
  return pin;
}

void Servo::detach() {
  if (place < 0) return;
  while (reg(machine(place) + ADDRESS) != REST) {}  // a pulse ends as it should
  clearBits(block(place) + CONTROL, 1u << (place % 4));
  pinMode(pinOf[place], OUTPUT);
  pinOf[place] = -1;
  place = -1;
}

void Servo::write(int value) {
  writeMicroseconds(value < 200 ? map(constrain(value, 0, 180), 0, 180, lowest, highest) : value);
}

void Servo::writeMicroseconds(int value) {
  width = constrain(value, lowest, highest);
  if (place >= 0) send(place, width);
}

int Servo::read() { return map(width, lowest, highest, 0, 180); }
