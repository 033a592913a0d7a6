#include "simpletools.h"
#include "fdserial.h"
#include "servo.h"

unsigned int later = 0;
static unsigned int after(unsigned int from) { return from + 8000; }

int main(void) {
  unsigned int next = 0, ticks = 80000;
  next = CNT;
  waitcnt(next += ticks);
  waitcnt(CNT + 230);
  waitcnt(ticks + CNT);
  waitcnt(after(CNT));
  later = later + CNT;
  waitcnt(later);
  next = waitcnt2(next, ticks);
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
