// expect D9=1 D8=2
#include "simpletools.h"
struct { unsigned red : 5, green : 5; } leds = { 0, 1 };
static int state;
static void put(unsigned pin, int on) { if (on) state |= 1 << pin; else state &= ~(1 << pin); OUTA = state; }
int main() { DIRA = 1 << leds.red | 1 << leds.green; put(leds.red, 1); pause(1); put(leds.red, 0); for (int i = 0; i < 2; i++) { put(leds.green, 1); pause(1); put(leds.green, 0); pause(1);} while (1); }
