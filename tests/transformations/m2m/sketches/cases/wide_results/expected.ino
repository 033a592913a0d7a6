#include <limits.h>

byte buf[8];
int samples[50];
int four[4];
uint16_t d = 0 - 1;
long v;
bool b;

void setup() {
  v = int16_t(70000);
  v = int(700);
  v = (uint16_t)((unsigned)-1) / 2;
  b = d > (uint16_t)(-1);
  b = d > 1;
  b = (signed char)200 > 0;
  b = (char)100 > 0;
  v = UINT16_MAX + 1;
  v = UINT16_MAX;
  v = INT_MAX;
  v = sizeof(samples);
  v = sizeof(four) / sizeof(four[0]) + sizeof(four) / sizeof(int);
  v = sizeof buf / sizeof(int16_t);
  delayMicroseconds((uint16_t)(70000));
  delayMicroseconds(700);
}

void loop() {}
