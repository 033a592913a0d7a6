/* pwm2ch.h of the Simple Libraries: pulses of a set width in a set cycle, on two pins. */
#ifndef PWM2CH_H
#define PWM2CH_H
#include "simpletools.h"
typedef struct pwm2ch_st {
  volatile unsigned int tCycle, ticksA, ticksB, ctra, ctrb, pin;
  volatile int pwm2cog;
  int pwm2stack[100];
} pwm2ch_t;
typedef pwm2ch_t pwm2ch;
pwm2ch *pwm2ch_start(unsigned int cycleMicroseconds);
void pwm2ch_set(pwm2ch *device, int pin, int channel, int tHigh);
void pwm2ch_stop(pwm2ch *device);
#endif
