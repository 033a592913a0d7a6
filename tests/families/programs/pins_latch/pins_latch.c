/* A button switches a lamp; a pin is let go and taken again and keeps what it was told. */
#include "simpletools.h"

const int lamp = 26;
int button = 3;

int main() {
  int before = 0, presses = 0;
  set_output(lamp, 1);
  print("%d%d", get_output(lamp), get_direction(lamp));
  set_direction(lamp, 1);
  pause(10);
  input(lamp);
  print("%d%d ", get_output(lamp), get_direction(lamp));
  pause(10);
  print("%d", reverse(lamp));
  pause(10);
  print("%d ", toggle(lamp));
  while (presses < 3) {
    int now = get_state(button);
    if (now && !before) {
      presses++;
      print("%d", toggle(lamp));
    }
    before = now;
    pause(5);
  }
  print("%d%d\n", reverse(lamp), get_output(lamp));
  high(lamp);
}
