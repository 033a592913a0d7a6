/* How far away something is, by a ranger with a pin to ask at and one that answers. */
#include "simpletools.h"

long centimetres(int trigger, int echo) {
  pulse_out(trigger, 10);
  return pulse_in(echo, 1) / 58;
}

int main() {
  low(8);
  while (1) {
    long distance = centimetres(8, 9);
    if (distance < 20) high(26);
    else low(26);
    print("%d cm\n", distance);
    pause(200);
  }
}
