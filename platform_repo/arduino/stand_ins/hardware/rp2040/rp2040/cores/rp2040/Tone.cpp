// Square waves, one for each pin, by a repeating timer.
#include <Arduino.h>
#include <hardware/gpio.h>
#include <pico/time.h>

namespace {

struct Wave {
  repeating_timer_t timer;
  uint8_t pin;
  bool on;
  uint32_t halvesLeft;  // 0: without end
};
Wave waves[8];

Wave *waveOf(uint8_t pin, bool make) {
  Wave *free = nullptr;
  for (Wave &each : waves) {
    if (each.on && each.pin == pin) return &each;
    if (!each.on && !free) free = &each;
  }
  return make ? free : nullptr;
}

bool half(repeating_timer_t *timer) {
  Wave &wave = *(Wave *)timer->user_data;
  gpio_xor_mask(1u << wave.pin);
  if (!wave.halvesLeft || --wave.halvesLeft) return true;
  gpio_put(wave.pin, false);
  return wave.on = false;
}

}  // namespace

void tone(uint8_t pin, unsigned int frequency, unsigned long duration) {
  if (!frequency) {
    noTone(pin);
    return;
  }
  Wave *wave = waveOf(pin, true);
  if (!wave || pin >= 30) return;
  int64_t period = -(int64_t)((500000 + frequency / 2) / frequency);
  uint32_t halves = (uint64_t)duration * frequency / 1000 * 2;
  wave->halvesLeft = !duration ? 0 : halves ? halves - 1 : 1;  // it ends low
  if (wave->on) {
    wave->timer.delay_us = period;  // from the next edge on, as the core's own: earlephilhower/arduino-pico#186
    return;
  }
  pinMode(pin, OUTPUT);
  wave->pin = pin;
  wave->on = true;
  gpio_put(pin, true);
  add_repeating_timer_us(period, half, wave, &wave->timer);
}

void noTone(uint8_t pin) {
  Wave *wave = waveOf(pin, false);
  if (!wave) return;
  cancel_repeating_timer(&wave->timer);
  wave->on = false;
  gpio_put(pin, false);
}
