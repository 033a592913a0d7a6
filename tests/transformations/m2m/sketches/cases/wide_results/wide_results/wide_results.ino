#include <limits.h>

byte buf[8];
int samples[50];
int four[4];
unsigned int d = 0 - 1;
long v;
bool b;

void setup() {
  v = int(70000);
  v = int(700);
  v = (unsigned)-1 / 2;
  b = d > -1;
  b = d > 1;
  b = (char)200 > 0;
  b = (char)100 > 0;
  v = UINT16_MAX + 1;
  v = UINT16_MAX;
  v = INT_MAX;
  v = sizeof(samples);
  v = sizeof(four) / sizeof(four[0]) + sizeof(four) / sizeof(int);
  v = sizeof buf / sizeof(int);
  delayMicroseconds(70000);
  delayMicroseconds(700);
}

void loop() {}
