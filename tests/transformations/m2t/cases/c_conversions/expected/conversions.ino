// conversions: conversions.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdlib.h>

#include "adapters.h"

enum mode { OFF, ON };
struct item { int32_t n; struct item *next; };

enum mode current = (enum mode)0;
char *title = (char *)"robot";
unsigned char levels[] = {0, 128, 255};

struct item *make(int32_t n)
{
  struct item *made = (struct item *)malloc(sizeof(struct item));
  made->n = n;
  made->next = 0;
  return made;
}

void take(char *text, enum mode m) { current = m; title = text; }

int32_t *raw;
struct item *list;

void setup() {
  int32_t address = (int32_t)&levels[1];
  raw = (int32_t *)calloc(4, sizeof(int32_t));
  void *any = raw;
  list = make(1);
  take((char *)"text", (enum mode)1);
  raw = (int32_t *)any;
  current = address ? ON : (enum mode)0L;
}

void loop() {
  list->next = make(list->n + 1);
  free(raw);
  pause(levels[0]);
}
