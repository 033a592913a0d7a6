/* A remote control: keys are counted, and one of them switches a lamp. */
#include "simpletools.h"
#include "sirc.h"

int main() {
  int power = 0;
  sirc_setTimeout(200);
  while (1) {
    int key = sirc_button(10);
    if (key == -1) {
      print("-\n");
      continue;
    }
    print("key %d\n", key);
    if (key == 21) {
      power = !power;
      set_output(4, power);
      set_direction(4, 1);
    }
    pause(100);
  }
}
