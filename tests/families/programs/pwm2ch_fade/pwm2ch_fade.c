/* A lamp that is made brighter step by step, and off at the end. */
#include "simpletools.h"
#include "pwm2ch.h"

const int LAMP = 20;

int main() {
  pwm2ch *dimmer = pwm2ch_start(2000);
  for (int high = 500; high <= 1500; high += 500) {
    pwm2ch_set(dimmer, LAMP, 1, high);
    pause(30);
  }
  pwm2ch_stop(dimmer);
  pause(30);
}
