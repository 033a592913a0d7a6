#include "simpletools.h"

enum { RED, GREEN, BLUE, COUNT };
typedef struct { int pin; int ms; } lamp;
static const unsigned char ports[COUNT] = { [GREEN] = 9, [RED] = 8, [BLUE] = 9 };
static const lamp lamps[] = { [1] = { .ms = 100, .pin = 9 }, [0] = { .pin = 8, .ms = 200 } };

int main() {
  while (1) {
    for (int i = RED; i < COUNT; i++) high(ports[i]);
    pause(100);
    for (int i = RED; i < COUNT; i++) low(ports[i]);
    for (int i = 0; i < 2; i++) { high(lamps[i].pin); pause(lamps[i].ms); low(lamps[i].pin); }
  }
}
