/* A parking aid: a ranger looks back, a lamp is lit near a wall, a button counts how often the driver has begun anew,
   a barrier is moved by pulses of its own, and a bell hangs on an open drain line. */
#include "simpletools.h"
#include "ping.h"

const int ranger = 15;
const int lamp = 4;
const int button = 3;
const int barrier = 9;
const int bell = 6;
const int nearBy = 50;      // centimetres

int looks = 0;
int begun = 0;

int main() {
  set_output(bell, 0);
  print("parking aid 2, ranger on 15\n");
  while (1) {
    int cm = ping_cm(ranger);
    looks++;
    print("look %d: %d cm\n", looks, cm);
    if (cm < nearBy) {
      high(lamp);
      set_direction(bell, 1);
    } else {
      low(lamp);
      set_direction(bell, 0);
    }
    if (input(button) == 1) {
      begun++;
      print("begun %d\n", begun);
      pulse_out(barrier, 1700);
    } else {
      pulse_out(barrier, 1200);
    }
    pause(200);
  }
}
