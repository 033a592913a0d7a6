/* dac2ch.h: a cog keeps its two counters as the program wants them; a negative value lets go of the pin. Source: libdac2ch/dac2ch.c. */
#include "dac2ch.h"

static void keep(int counter, unsigned control, unsigned step) {
  unsigned before = *host_register(HOST_CTRA + counter);
  if (control != before) {
    if (before) DIRA &= ~(1u << (before & 31));
    *host_register(HOST_CTRA + counter) = control;
    if (control) DIRA |= 1u << (control & 31);
  }
  *host_register(HOST_FRQA + counter) = step;
}

static void drive(void *parameter) {
  dac2ch *device = parameter;
  for (;;) {
    keep(0, device->ctra, device->frqa);
    keep(1, device->ctrb, device->frqb);
    host_spend(100 * HOST_TICKS_PER_US);
  }
}

dac2ch *dac2ch_start(int bits) {
  dac2ch *device = calloc(1, sizeof *device);
  host_call();
  if (!device) return 0;
  device->dacCtrBits = bits;
  device->dacBitX = 32 - bits;
  device->dac2chCog = host_start(drive, device, -1) + 1;
  return device;
}

void dac2ch_stop(dac2ch *device) {
  host_call();
  if (device->dac2chCog) host_stop(device->dac2chCog - 1);
  device->dac2chCog = 0;
  free(device);
}

void dac2ch_set(dac2ch *device, int pin, int channel, int dacVal) {
  host_call();
  unsigned control = dacVal < 0 ? 0 : 6u << 26 | (pin & 31), step = dacVal < 0 ? 0 : (unsigned)dacVal << device->dacBitX;
  if (channel) device->ctrb = control, device->frqb = step;
  else device->ctra = control, device->frqa = step;
}
