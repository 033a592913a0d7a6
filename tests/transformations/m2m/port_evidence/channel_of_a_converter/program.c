#include "simpletools.h"
#include "adcDCpropab.h"
int main() { adc_init(21, 20, 19, 18); print("%d", adc_in(2)); }
