#include "simpletools.h"
#include "adcDCpropab.h"

const int mark1 = 3, mark2 = 4;

int main()
{
  adc_init(21, 20, 19, 18);
  high(mark1);
  low(mark2);
  high(1);
  print("%d %d %d", adc_in(0), adc_in(1), adc_in(2));
}
