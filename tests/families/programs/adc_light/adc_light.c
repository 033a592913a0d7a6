/* A line sensor by a table of channels: the darker side lights its lamp. */
#include "simpletools.h"
#include "adcDCpropab.h"

int lamp[] = {26, 27};

int main() {
  int value[2];
  adc_init(21, 20, 19, 18);
  while (1) {
    for (int ch = 0; ch < 2; ch++)
      value[ch] = adc_in(ch);
    int dark = value[0] < value[1] ? 0 : 1;
    high(lamp[dark]);
    low(lamp[1 - dark]);
    pause(20);
  }
}
