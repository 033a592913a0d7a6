#include "simpletools.h"
#include "adcDCpropab.h"

int main() {
  adc_init(21, 20, 19, 18);
  while (1) {
    if (adc_in(2) > 2000) high(6);
    else low(6);
    pause(50);
  }
}
