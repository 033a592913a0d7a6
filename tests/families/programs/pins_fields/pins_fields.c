/* A row of lights that is written and read as a field of bits. */
#include "simpletools.h"

int main() {
  set_directions(9, 6, 0b1111);
  set_outputs(9, 6, 0b0101);
  pause(20);
  set_outputs(6, 9, 0b1010);
  pause(30);
  print("%d %d\n", get_outputs(9, 6), get_outputs(7, 6));
  set_outputs(7, 6, 0b101);
  pause(40);
  print("%d\n", get_outputs(6, 9));
  set_directions(9, 8, 0);
  print("%04b %d\n", get_directions(9, 6), get_states(7, 6));
  pause(50);
  set_outputs(9, 9, 0);
  set_directions(8, 9, 3);
  pause(10);
  print("%b", get_states(9, 6));
}
