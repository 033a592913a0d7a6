// names: names.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t port = 3;               // port of the adapters
enum { COG_STACK, Servo_ };
void pause(int32_t ms) { print("%d", ms); }
int32_t Io_(int32_t TextOut) { return TextOut + port; }

int32_t console_ = 2, cogs_running = 1;

void setup() {
  Serial.begin(115200);
}

void loop() {
  console_ = ping_cm(255 /* P8 is not wired yet */) + Io_(3) + cogs_running + Servo_;
  servo_angle(255 /* P12 is not wired yet */, console_);
  freqout(255 /* P4 is not wired yet */, 100, 1000);
  pause(port);
}
