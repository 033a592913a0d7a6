// ports: ports.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

const int32_t buttonPin = 2;
#define LED_PIN 13
#define PINS_PER_SIDE (2)
enum { SENSOR_PIN = A0, BUZZER_PIN = 9 };
static const int32_t rows[3] = {255 /* P10 is not wired yet */, 255 /* P11 is not wired yet */, 255 /* P12 is not wired yet */};
int32_t relay = 7;

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
  pulse(8);
  high(relay);
  for (i = 0; i < 3; i++) low(rows[i]);
  freqout(BUZZER_PIN, 100, 3000);
  pause(100);
}
