/* adcDCpropab.h of the Simple Libraries: the board's converter of four channels and 12 bits. */
#ifndef PROPAB_ADC_DC_H
#define PROPAB_ADC_DC_H
#include "simpletools.h"
void adc_init(int csPin, int sclPin, int doPin, int diPin);
int adc_in(int channel);
float adc_volts(int channel);
#endif
