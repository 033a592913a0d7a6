/* dacctr.h of the Simple Libraries: mean voltages by the counters of a cog. */
#ifndef ROBOSMI_DACCTR_H
#define ROBOSMI_DACCTR_H
#include "simpletools.h"
#ifndef DUTY_SE
#define DUTY_SE (6 << 26)
#endif
#ifndef NEW_COG
#define NEW_COG 2
#endif
typedef struct DacControl { volatile int daCog, daPin, daBitX, daCh, daCtr, daVal; } dac;
typedef struct DacAddr {
  volatile unsigned int daDt;
  dac *da0, *da1;
} daca;
typedef struct DacCogMemory { unsigned int stack[64]; } dacmem;
dac dac_setup(int pin, int channel, int bits);
void dac_set(dac *da, int value);
void dac_close(dac *da);
int dac_start(dacmem mem, int sampleRate, dac *da0, dac *da1);
int dac_stop(int cogid);
#endif
