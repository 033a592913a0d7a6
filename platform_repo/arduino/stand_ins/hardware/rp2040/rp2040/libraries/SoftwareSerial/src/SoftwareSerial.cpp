#include "SoftwareSerial.h"

#include <hardware/gpio.h>
#include <hardware/sync.h>

namespace {

void waitUntil(uint32_t begun, uint32_t sixteenths) {
  uint32_t us = (sixteenths + 8) / 16;
  while (micros() - begun < us) {}
}

}  // namespace

void SoftwareSerial::begin(unsigned long baud) {
  end();
  bit = 16000000 / baud;
  if (tx < NUM_DIGITAL_PINS) {
    pinMode(tx, INPUT_PULLUP);
    gpio_put(tx, !invertTx);  // before it drives: no start bit
    gpio_set_dir(tx, true);
  }
  if (rx >= NUM_DIGITAL_PINS) return;
  pinMode(rx, INPUT_PULLUP);
  attachInterrupt(rx, [](void *own) { ((SoftwareSerial *)own)->receive(); }, invertRx ? RISING : FALLING, this);
}

void SoftwareSerial::end() {
  if (bit && rx < NUM_DIGITAL_PINS) detachInterrupt(rx);
  bit = 0;
}

void SoftwareSerial::receive() {
  if (gpio_get(rx) != invertRx) return;  // an edge within the byte before
  uint32_t begun = micros();
  uint8_t byte = 0;
  for (int place = 0; place < 8; place++) {
    waitUntil(begun, bit * place + bit * 3 / 2);
    byte |= (gpio_get(rx) != invertRx) << place;
  }
  waitUntil(begun, bit * 19 / 2);
  if ((uint8_t)(last + 1) == first) {
    lost = true;
    return;
  }
  buffer[last] = byte;
  last = last + 1;
}

bool SoftwareSerial::overflow() {
  bool before = lost;
  lost = false;
  return before;
}

int SoftwareSerial::read() {
  int byte = peek();
  if (byte >= 0) first = first + 1;
  return byte;
}

size_t SoftwareSerial::write(uint8_t byte) {
  if (!bit || tx >= NUM_DIGITAL_PINS) return 0;
  uint32_t state = save_and_disable_interrupts(), begun = micros(), frame = byte << 1 | 0x200;
  for (int place = 0; place < 10; place++) {
    gpio_put(tx, (frame >> place & 1) != invertTx);
    waitUntil(begun, bit * (place + 1));
  }
  restore_interrupts(state);
  return 1;
}
