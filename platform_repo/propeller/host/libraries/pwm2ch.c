/* pwm2ch.h: a cog begins a pulse on each of its two counters in every cycle; a negative width lets go of the pin.
 * Source: libpwm2ch/pwm2ch.c. */
#include "pwm2ch.h"

static void keep(int counter, unsigned control) {
  unsigned before = *host_register(HOST_CTRA + counter);
  if (control == before) return;
  if (before) DIRA &= ~(1u << (before & 31));
  *host_register(HOST_CTRA + counter) = control;
  if (control) DIRA |= 1u << (control & 31);
}

static void drive(void *parameter) {
  pwm2ch *device = parameter;
  unsigned next = CNT, cycle = device->tCycle;
  FRQA = FRQB = 1;
  for (;;) {
    host_wait_counter(next += cycle);
    keep(0, device->ctra);
    keep(1, device->ctrb);
    PHSA = -device->ticksA;
    PHSB = -device->ticksB;
  }
}

pwm2ch *pwm2ch_start(unsigned int cycleMicroseconds) {
  pwm2ch *device = calloc(1, sizeof *device);
  host_call();
  if (!device) return 0;
  device->tCycle = cycleMicroseconds * HOST_TICKS_PER_US;
  device->pwm2cog = host_start(drive, device, -1) + 1;
  return device;
}

void pwm2ch_stop(pwm2ch *device) {
  host_call();
  if (device->pwm2cog) host_stop(device->pwm2cog - 1);
  device->pwm2cog = 0;
  free(device);
}

void pwm2ch_set(pwm2ch *device, int pin, int channel, int tHigh) {
  host_call();
  unsigned control = tHigh < 0 ? 0 : 4u << 26 | (pin & 31), ticks = tHigh * st_usTicks;
  if (channel) device->ctrb = control, device->ticksB = ticks;
  else device->ctra = control, device->ticksA = ticks;
}
