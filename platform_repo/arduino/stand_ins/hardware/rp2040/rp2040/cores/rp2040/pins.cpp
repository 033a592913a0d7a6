// Digital pins, their interrupts, pulses.
#include <Arduino.h>
#include <hardware/gpio.h>
#include <hardware/irq.h>
#include <hardware/sync.h>

#include "registers.h"

namespace {

constexpr int PINS = 30;
constexpr uint32_t PULL_UP = 8, PULL_DOWN = 4, INPUT_ON = 0x40, OUTPUT_OFF = 0x80;
uint32_t openDrain;  // pins with INPUT_PULLUP: written high they are let go
void (*handlers[PINS])();
void (*argumentHandlers[PINS])(void *);
void *arguments[PINS];
uint32_t statesBefore[8];
int disabled;

uint32_t events(int pin) { return IO_BANK + 0x100 + 4 * (pin >> 3); }
uint32_t latched(int pin) { return IO_BANK + 0xf0 + 4 * (pin >> 3); }

void digitalPin(int pin) {
  if (reg(pinControl(pin)) != FUNCTION_SIO) selectFunction(pin, FUNCTION_SIO);
}

void pinsChanged() {
  for (int first = 0; first < PINS; first += 8) {
    uint32_t raised = reg(IO_BANK + 0x120 + 4 * (first >> 3));
    reg(latched(first)) = raised & 0xcccccccc;
    for (int pin = first; raised; pin++, raised >>= 4) {
      if (!(raised & 15)) continue;
      if (handlers[pin]) handlers[pin]();
      else if (argumentHandlers[pin]) argumentHandlers[pin](arguments[pin]);
    }
  }
}

void attach(int pin, PinStatus mode) {
  uint32_t wanted = mode == RISING ? 8 : mode == FALLING ? 4 : mode == CHANGE ? 12 : mode == HIGH ? 2 : 1;
  reg(latched(pin)) = 12u << 4 * (pin & 7);  // forget earlier edges
  setBits(events(pin), wanted << 4 * (pin & 7));
  irq_set_exclusive_handler(IO_IRQ_BANK0, pinsChanged);
  irq_set_enabled(IO_IRQ_BANK0, true);
}

unsigned long pulse(uint8_t pin, uint8_t state, unsigned long timeout) {
  if (pin >= PINS) return 0;
  uint32_t mask = 1u << pin, level = state ? mask : 0, begun = micros();
  volatile uint32_t &in = reg(SIO_IN);
  while ((in & mask) == level)
    if (micros() - begun >= timeout) return 0;
  while ((in & mask) != level)
    if (micros() - begun >= timeout) return 0;
  uint32_t from = micros();
  while ((in & mask) == level)
    if (micros() - begun >= timeout) return 0;
  return micros() - from;
}

}  // namespace

void selectFunction(int pin, PinFunction function) {
  reg(pad(pin)) = (reg(pad(pin)) & ~OUTPUT_OFF) | INPUT_ON;
  reg(pinControl(pin)) = function;
}

extern "C" {

void gpio_init(unsigned pin) {
  gpio_set_dir(pin, false);
  gpio_put(pin, false);
  selectFunction(pin, FUNCTION_SIO);
}
void gpio_set_function(unsigned pin, enum gpio_function function) { selectFunction(pin, (PinFunction)function); }
enum gpio_function gpio_get_function(unsigned pin) { return (enum gpio_function)(reg(pinControl(pin)) & 31); }
void gpio_set_pulls(unsigned pin, bool up, bool down) {
  reg(pad(pin)) = (reg(pad(pin)) & ~(PULL_UP | PULL_DOWN)) | (up ? PULL_UP : 0) | (down ? PULL_DOWN : 0);
}
void gpio_set_input_enabled(unsigned pin, bool enabled) {
  if (enabled) setBits(pad(pin), INPUT_ON);
  else clearBits(pad(pin), INPUT_ON);
}

void pinMode(pin_size_t pin, PinMode mode) {
  if (pin >= PINS) return;
  gpio_set_dir(pin, false);  // before the latch is cleared: a charged line sees no pulse
  gpio_put(pin, false);      // as arduino-pico does: what was written before is forgotten
  gpio_set_pulls(pin, mode == INPUT_PULLUP, mode == INPUT_PULLDOWN);
  openDrain = mode == INPUT_PULLUP ? openDrain | 1u << pin : openDrain & ~(1u << pin);
  selectFunction(pin, FUNCTION_SIO);
  if (mode == OUTPUT || mode >= OUTPUT_2MA) gpio_set_dir(pin, true);
}

void digitalWrite(pin_size_t pin, PinStatus value) {
  if (pin >= PINS) return;
  digitalPin(pin);
  if (openDrain >> pin & 1) gpio_set_dir(pin, value == LOW);
  else gpio_put(pin, value != LOW);
}

PinStatus digitalRead(pin_size_t pin) { return pin < PINS && gpio_get(pin) ? HIGH : LOW; }

void attachInterrupt(pin_size_t pin, voidFuncPtr handler, PinStatus mode) {
  if (pin >= PINS) return;
  detachInterrupt(pin);
  handlers[pin] = handler;
  attach(pin, mode);
}
void detachInterrupt(pin_size_t pin) {
  if (pin >= PINS) return;
  clearBits(events(pin), 15u << 4 * (pin & 7));
  handlers[pin] = nullptr;
  argumentHandlers[pin] = nullptr;
}

void noInterrupts() {  // they nest
  uint32_t state = save_and_disable_interrupts();
  if (disabled < 8) statesBefore[disabled] = state;
  disabled++;
}
void interrupts() {
  if (!disabled) return;
  disabled--;
  if (disabled < 8) restore_interrupts(statesBefore[disabled]);
}

void shiftOut(pin_size_t data, pin_size_t clock, BitOrder order, uint8_t value) {
  for (int place = 0; place < 8; place++) {
    digitalWrite(data, value >> (order == LSBFIRST ? place : 7 - place) & 1);
    digitalWrite(clock, HIGH);
    digitalWrite(clock, LOW);
  }
}
uint8_t shiftIn(pin_size_t data, pin_size_t clock, BitOrder order) {
  uint8_t value = 0;
  for (int place = 0; place < 8; place++) {
    digitalWrite(clock, HIGH);
    value |= digitalRead(data) << (order == LSBFIRST ? place : 7 - place);
    digitalWrite(clock, LOW);
  }
  return value;
}

}

void attachInterrupt(uint8_t pin, void (*handler)(void *), PinStatus mode, void *argument) {
  if (pin >= PINS) return;
  detachInterrupt(pin);
  argumentHandlers[pin] = handler;
  arguments[pin] = argument;
  attach(pin, mode);
}

unsigned long pulseIn(uint8_t pin, uint8_t state, unsigned long timeout) { return pulse(pin, state, timeout); }
unsigned long pulseInLong(uint8_t pin, uint8_t state, unsigned long timeout) { return pulse(pin, state, timeout); }
