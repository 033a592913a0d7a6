// comments: comments.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

// the library
/* before main */
/* between */
void setup() {
  /* opening */
  /* own line */ high(255 /* P1 is not wired yet */); /* behind high */
  /* before the loop */
}

/* in the head */
/* behind the head */
void loop() {
  // opening of the loop
  low(255 /* P1 is not wired yet */); // behind low
  /* last in the loop */
}
// closing of the loop
/* last in main */
/* closing */
// behind main
