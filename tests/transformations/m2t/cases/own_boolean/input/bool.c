#include "simpletools.h"

typedef unsigned char byte;
typedef int bool;
#define true 1
#define false 0
#define PI 3

bool on = false;
byte count;

int main()
{
  while (1) {
    on = !on;
    count += PI;
    if (on == true) pause(count);
  }
}
