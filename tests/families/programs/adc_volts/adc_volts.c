/* Voltages at the channels of the board's converter. */
#include "simpletools.h"
#include "adcDCpropab.h"

int main() {
  adc_init(21, 20, 19, 18);
  for (int n = 0; n < 3; n++) {
    print("%d %d %.2f\n", adc_in(0), adc_in(3), adc_volts(3));
    pause(100);
  }
}
