// conversions: conversions.c moved from propeller to Arduino Uno.
// Made by RoboSMi 0.1.0. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>
#include <stdlib.h>

#include "adapters.h"

enum mode { OFF, ON };
struct item { int n; struct item *next; };

enum mode current = (enum mode)0;
char *title = (char *)"robot";
unsigned char levels[] = {0, 128, 255};

struct item *make(int n)
{
  struct item *made = (struct item *)malloc(sizeof(struct item));
  made->n = n;
  made->next = 0;
  return made;
}

void take(char *text, enum mode m) { current = m; title = text; }

int *raw;
struct item *list;

void setup() {
  int address = (int)&levels[1];
  raw = (int *)calloc(4, sizeof(int));
  void *any = raw;
  list = make(1);
  take((char *)"text", (enum mode)1);
  raw = (int *)any;
  current = address ? ON : (enum mode)0;
}

void loop() {
  list->next = make(list->n + 1);
  free(raw);
  pause(levels[0]);
}
