// libping: ping.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

int32_t ping(int32_t pin) { return pulse_in(pin, 1); }
int32_t ping_cm(int32_t pin) { return ping(pin) / 58; }
int32_t ping_inches(int32_t pin) { return ping(pin) / 148; }
