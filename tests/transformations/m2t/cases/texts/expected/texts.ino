// texts: texts.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

#define VERSION "1.0"

char *url = (char *)"http://example.org/*no comment*/";

void setup() {
}

void loop() {
  print("v"VERSION"\n");
  print("%s // %c\n", url, VERSION[0]);
  pause(10);
}
