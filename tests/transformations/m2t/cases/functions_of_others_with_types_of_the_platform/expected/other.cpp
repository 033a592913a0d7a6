// functions_of_others_with_types_of_the_platform: other.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdint.h>

#include "adapters.h"

int32_t helper(fdserial *to) { fdserial_txChar(to, 'a'); return 3; }
int32_t wide(uint8_t x) { return x; }
