#include "simpletools.h"
#include "ping.h"
#include "wheels.h"
#define CLOSE 20
#define TOO_CLOSE(d) ((d) < CLOSE)

static int (*look)(int) = ping_cm;

int distance(void) { return look(8); }

int main(void)
{
  i2c *bus = i2c_newbus(28, 29, 0);
  print("%c ready\n", HOME);
  while (1) {
    if (TOO_CLOSE(distance())) turn();
    else forward(CLOSE);
    pause(10);
  }
}
