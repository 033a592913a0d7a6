/* dac2ch.h of the Simple Libraries: two voltages by the duty of pins. */
#ifndef DAC2CH_H
#define DAC2CH_H
#include "simpletools.h"
typedef struct dac2ch_st {
  volatile unsigned int dacCtrBits, dacBitX, ctra, ctrb, frqa, frqb, pin;
  volatile int dac2chCog;
  int dac2chStack[100];
} dac2ch_t;
typedef dac2ch_t dac2ch;
dac2ch *dac2ch_start(int bits);
void dac2ch_set(dac2ch *device, int pin, int channel, int dacVal);
void dac2ch_stop(dac2ch *device);
#endif
