/* dacctr.h: duty of the counters of the cog that asks, or of one that takes a new value with each sample. Source: libdacctr/dacctr.c. */
#include "dacctr.h"

dac dac_setup(int pin, int channel, int bits) {
  host_call();
  return (dac){channel > 1 ? -1 : host_self(), pin, 32 - bits, channel, DUTY_SE | pin, 0};
}

void dac_set(dac *da, int value) {
  host_call();
  if (host_self() != da->daCog) {
    da->daVal = value;
    return;
  }
  int second = da->daCh != 0;
  *host_register(HOST_CTRA + second) = da->daCtr;
  *host_register(HOST_FRQA + second) = (unsigned)value << da->daBitX;
  DIRA |= 1u << da->daPin;
}

void dac_close(dac *da) {
  host_call();
  DIRA &= ~(1u << da->daPin);
  int second = da->daCh != 0;
  *host_register(HOST_CTRA + second) = 0;
  *host_register(HOST_FRQA + second) = 0;
}

static void samples(void *parameter) {
  daca *both = parameter;
  dac *of[2] = {both->da0, both->da1};
  host_time next = host_now();
  unsigned step = both->daDt;
  for (int k = 0; k < 2; k++) {
    if (!of[k]) continue;
    if (!k && of[k]->daVal < 0) of[k]->daVal = -of[k]->daVal;
    *host_register(HOST_CTRA + k) = of[k]->daCtr;
    DIRA |= 1u << of[k]->daPin;
    of[k]->daCog = host_self();
  }
  for (;;) {
    host_sleep_until(next += step);
    for (int k = 0; k < 2; k++)
      if (of[k]) *host_register(HOST_FRQA + k) = (unsigned)of[k]->daVal << of[k]->daBitX;
  }
}

int dac_start(dacmem mem, int sampleRate, dac *da0, dac *da1) {
  (void)mem;
  host_call();
  daca both = {HOST_HZ / sampleRate, da0, da1};
  dac *of[2] = {da0, da1};
  for (int k = 0; k < 2; k++) {
    if (!of[k]) continue;
    of[k]->daCog = -1;
    of[k]->daCh = k;
    if (of[k]->daBitX < 0) of[k]->daBitX = -of[k]->daBitX;
  }
  int cog = host_start(samples, &both, -1);
  while (cog >= 0 && ((da0 && da0->daCog == -1) || (da1 && da1->daCog == -1))) host_call();
  return cog;
}

int dac_stop(int cogid) {
  host_call();
  host_stop(cogid);
  return 0;
}
