#include "simpletools.h"
int ticks;
unsigned char bytes[2];

int main(void)
{
  ticks = input(3);
  scan("%d", &ticks);
  pause(ticks * 1000);  // RS314
  ticks = (bytes[1] << 8) | bytes[0];  // RS314
  set_outputs(31, 0, 1 << ticks);  // RS314
}
