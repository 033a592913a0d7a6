/* adcDCpropab.h: 12 bits of 5 V. The converter is read twice, 16 bits each; its pins are left as the reading leaves them, the bits
 * themselves are not played. Source: libadcDCpropab. */
#include "adcDCpropab.h"

static int select_pin, clock_pin, out_pin, in_pin;

void adc_init(int csPin, int sclPin, int doPin, int diPin) {
  select_pin = csPin, clock_pin = sclPin, out_pin = doPin, in_pin = diPin;
}

int adc_in(int channel) {
  enum { CALLS_OF_A_READING = 2 * (5 + 16 * 4) };
  long long level;
  high(select_pin);
  high(clock_pin);
  low(in_pin);
  input(out_pin);
  for (int i = 0; i < CALLS_OF_A_READING; i++) host_call();
  level = host_millivolts(channel & 3) * 4096LL / 5000;
  return level < 0 ? 0 : level > 4095 ? 4095 : (int)level;
}

float adc_volts(int channel) { return adc_in(channel) * 5.0 / 4096.0; }
