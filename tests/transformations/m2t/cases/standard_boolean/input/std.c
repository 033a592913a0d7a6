#include <stdbool.h>
#include <stdint.h>
#include "simpletools.h"

bool on = false;
uint8_t count;

int main()
{
  while (true) {
    on = !on;
    count++;
    pause(count);
  }
}
