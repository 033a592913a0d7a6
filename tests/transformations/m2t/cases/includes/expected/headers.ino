// headers: headers.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdio.h>  // sprintf
#include <math.h>

#include "adapters.h"

/* sqrt
   and more */
// usleep
/* for
   the arm */
#ifdef WITH_STRINGS
#include <string.h>
#endif

void setup() {
  servo_speed(255 /* P16 is not wired yet */, (int32_t)sqrt(400.0));
}

void loop() {
  usleep(100);
  pause(1);
}
