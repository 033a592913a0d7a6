#include "simpletools.h"
#include "fdserial.h"
#include "servo.h"
#define SHRILL 70000
enum { FAST = 115200 };
const int tones[] = {440, 20, 880};

void beep(int hertz) {
  freqout(4, 100, hertz);  // RS334: freqout(4, 100, hertz)
}

unsigned int later;

int main(void) {
  waitcnt(800000);  // RS334: waitcnt(800000)
  waitcnt(CLKFREQ / 2);  // RS334: waitcnt(CLKFREQ / 2)
  later = 400;
  waitcnt(later * 2);  // RS334: waitcnt(later * 2)
  waitcnt2(230, later);  // RS334: waitcnt2(230, later)
  square_wave(4, 0, SHRILL);  // RS334: square_wave(4, 0, SHRILL)
  for (int i = 0; i < 3; i++) beep(tones[i]);
  dac_ctr_res(10);  // RS334: dac_ctr_res(10)
  fdserial *line = fdserial_open(7, 8, 0, FAST);  // RS334: fdserial_open(7, 8, 0, FAST)
  fdserial *slow = fdserial_open(9, 10, 0, 38400);  // RS334: fdserial_open(9, 10, 0, 38400)
  servo_angle(12, 900);
  servo_set(12, 3200);  // RS334: servo_set(12, 3200)
}
