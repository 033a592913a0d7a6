#include <stdio.h>
#include "moods.h"
void (*shared)();
static void say(const char *text, int n) { printf("%s %d\n", text, n); }
void each(void (*what)()) { what(2, 70000); }
void begin(void) { shared = say; }
static level_t half(level_t of) { return of / 2; }
sensor_t sensors[2] = { { half, 1 }, { .read = half, .pin = 2 } };
