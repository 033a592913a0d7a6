// ports: ports.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

const int32_t buttonPin = 255 /* P3 is not wired yet */;
#define LED_PIN 255 /* P26 is not wired yet */
#define PINS_PER_SIDE (2)
enum { SENSOR_PIN = 255 /* P7 is not wired yet */, BUZZER_PIN = 255 /* P8 is not wired yet */ };
static const int32_t rows[3] = {255 /* P10 is not wired yet */, 255 /* P11 is not wired yet */, 255 /* P12 is not wired yet */};
int32_t relay = 255 /* P15 is not wired yet */;

void pulse(int32_t pin)
{
  high(pin);
  low(pin);
}

int32_t i;

void setup() {
}

void loop() {
  if (input(buttonPin)) high(LED_PIN);
  if (input(SENSOR_PIN)) pulse(BUZZER_PIN);
  pulse(255 /* P4 is not wired yet */);
  high(relay);
  for (i = 0; i < 3; i++) low(rows[i]);
  freqout(BUZZER_PIN, 100, 3000);
  pause(100);
}
