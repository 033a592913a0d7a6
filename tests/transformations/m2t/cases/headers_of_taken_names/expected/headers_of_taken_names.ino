// headers_of_taken_names: headers_of_taken_names.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#include "own_adapters.h"
#include "own_Print.h"

void setup() {
}

void loop() {
  high(port(QA));
  pause((int32_t)QB * QC + quarter());
}
