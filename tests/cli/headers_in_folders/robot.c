#include "simpletools.h"
#include "left/wheel.h"
#include  <right/wheel.h>

int main() {
  print("%d %d\n", left_turns(20), right_turns(20));
  pause(100);
  left_turns(0);
  return 0;
}
