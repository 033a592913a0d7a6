/* The voltage at a potentiometer, and whether it is above a limit. */
#include "simpletools.h"
#include "adcDCpropab.h"

int main() {
  adc_init(21, 20, 19, 18);
  while (1) {
    float volts = adc_volts(2);
    if (volts > 2.0) high(26);
    else low(26);
    pause(100);
  }
}
