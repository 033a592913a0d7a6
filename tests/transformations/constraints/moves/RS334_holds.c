#include "simpletools.h"
#include "fdserial.h"
#include "servo.h"

int main(void) {
  int hertz = 440;
  square_wave(4, 0, hertz);
  square_wave(-4, 0, 0);
  freqout(4, 100, 31);
  freqout(4, 100, getDec());
  pwm_set(5, 0, 0);
  fdserial *console = fdserial_open(31, 30, 0, 115200);
  fdserial *line = fdserial_open(7, 8, 0, 9600);
  servo_angle(12, 1800);
  servo_set(12, 0);
}
