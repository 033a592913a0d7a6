// The converter, and PWM slices: two pins share one.
#include <Arduino.h>
#include <hardware/gpio.h>

#include "registers.h"

namespace {

constexpr int FIRST_INPUT = 26, INPUTS = 4, SLICES = 8, PINS = 30;
constexpr uint32_t LEAST_HERTZ = 100, MOST_HERTZ = 10000000, MOST_COUNTS = 65535;
uint32_t hertz = 1000, range = 255, counts[SLICES], hertzOf[SLICES];
int inputBits = 10;
bool converts;

}  // namespace

extern "C" {

void analogReadResolution(int bits) { inputBits = bits; }
void analogWriteResolution(int bits) { range = (1u << bits) - 1; }
void analogWriteRange(uint32_t top) { range = top; }
void analogWriteFreq(uint32_t frequency) { hertz = constrain(frequency, LEAST_HERTZ, MOST_HERTZ); }

int analogRead(pin_size_t pin) {
  if (pin < FIRST_INPUT || pin >= FIRST_INPUT + INPUTS) return 0;  // analogRead(0) is an input of an Uno, and none here
  gpio_set_dir(pin, false);
  reg(pad(pin)) &= ~0xccu;  // no pull, no digital input, no output
  reg(pinControl(pin)) = FUNCTION_NONE;
  if (!converts) {
    reg(ADC) = 1;
    while (!(reg(ADC) >> 8 & 1)) {}
    converts = true;
  }
  reg(ADC) = (uint32_t)(pin - FIRST_INPUT) << 12 | 5;
  while (!(reg(ADC) >> 8 & 1)) {}
  uint32_t value = reg(ADC + 4) & 0xfff;
  return inputBits >= 12 ? value << (inputBits - 12) : value >> (12 - inputBits);
}

void analogWrite(pin_size_t pin, int value) {
  if (pin >= PINS) return;
  uint32_t clock = F_CPU, divider = 1, period = clock / hertz;
  while (period > MOST_COUNTS) {
    divider *= 2;
    period = clock / divider / hertz;
  }
  uint32_t slice = pin >> 1 & 7, base = PWM + 20 * slice, shift = pin & 1 ? 16 : 0;
  uint32_t high = (uint64_t)constrain(value, 0, (int)range) * period / range;
  bool other = counts[slice] != period || hertzOf[slice] != hertz;
  if (other) {
    reg(base) = 0;
    reg(base + 4) = divider << 4;
    reg(base + 8) = 0;
    reg(base + 16) = period - 1;
    counts[slice] = period;
    hertzOf[slice] = hertz;
  }
  reg(base + 12) = (reg(base + 12) & ~(0xffffu << shift)) | high << shift;
  if (other) reg(base) = 1;
  selectFunction(pin, FUNCTION_PWM);
}

}
