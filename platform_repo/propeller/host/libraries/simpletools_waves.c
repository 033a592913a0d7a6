/* simpletools.h: waves that go on in a cog of their own. Sources: libsimpletools/source (dac.c, pwm.c, squareWave.c). */
#include "simpletools.h"

void square_wave_setup(int pin, int freq, int *control, int *step);

/* What the program wants of a cog's two counters; the cog takes it over within 100 us. */
struct wanted { volatile unsigned control[2], step[2]; };

static void keep(void *parameter) {
  struct wanted *wanted = parameter;
  for (;;) {
    for (int k = 0; k < 2; k++) {
      unsigned control = wanted->control[k], before = *host_register(HOST_CTRA + k);
      if (control != before) {
        if (before) DIRA &= ~(1u << (before & 31));
        *host_register(HOST_FRQA + k) = wanted->step[k];
        *host_register(HOST_CTRA + k) = control;
        if (control) DIRA |= 1u << (control & 31);
      }
      *host_register(HOST_FRQA + k) = wanted->step[k];
    }
    host_spend(100 * HOST_TICKS_PER_US);
  }
}

static struct wanted waves, converters;
static int wave_cog, converter_cog, converter_bits = 8, pulse_cog;

void square_wave(int pin, int channel, int freq) {
  int control, step;
  host_call();
  if (!wave_cog) wave_cog = host_start(keep, &waves, -1) + 1;
  square_wave_setup(pin, freq, &control, &step);
  waves.step[channel != 0] = pin < 0 ? 0 : step;
  waves.control[channel != 0] = pin < 0 ? 0 : control;
}

void square_wave_stop(void) {
  host_call();
  if (wave_cog) host_stop(wave_cog - 1);
  wave_cog = 0;
  waves = (struct wanted){{0, 0}, {0, 0}};
}

void dac_ctr_res(int bits) { converter_bits = bits ? bits : 8; }

void dac_ctr(int pin, int channel, int dacVal) {
  host_call();
  if (!converter_cog) converter_cog = host_start(keep, &converters, -1) + 1;
  converters.step[channel != 0] = (unsigned)dacVal << (32 - converter_bits);
  converters.control[channel != 0] = (6u << 26) + pin;
}

void dac_ctr_stop(void) {
  host_call();
  if (converter_cog) host_stop(converter_cog - 1);
  converter_cog = 0;
}

/* ---- pulses of a set width in a set cycle */

static volatile unsigned cycle_ticks, pulse_control[2], pulse_ticks[2];

static void pulses(void *unused) {
  (void)unused;
  unsigned next = CNT, cycle = cycle_ticks;
  FRQA = FRQB = 1;
  for (;;) {
    host_wait_counter(next += cycle);
    for (int k = 0; k < 2; k++) {
      volatile unsigned *control = host_register(HOST_CTRA + k);
      if (pulse_control[k] != *control) {
        *control = pulse_control[k];
        DIRA |= 1u << (pulse_control[k] & 31);
      }
      *host_register(HOST_PHSA + k) = -pulse_ticks[k];
    }
  }
}

int pwm_start(unsigned int cycleMicroseconds) {
  host_call();
  cycle_ticks = cycleMicroseconds * st_usTicks;
  pulse_cog = host_start(pulses, 0, -1) + 1;
  return pulse_cog;
}

void pwm_set(int pin, int channel, int tHigh) {
  host_call();
  pulse_control[channel != 0] = 4u << 26 | (pin & 31);
  pulse_ticks[channel != 0] = tHigh * st_usTicks;
}

void pwm_stop(void) {
  host_call();
  if (pulse_cog) host_stop(pulse_cog - 1);
  pulse_cog = 0;
}
