#include "simpletools.h"

#include <string.h>

#define PLACE(name) &name

static volatile unsigned *output(void)
{
  return &OUTA;  // RS350: OUTA
}

int main(void)
{
  volatile unsigned *parts[2] = {&DIRA, 0};  // RS350: DIRA
  unsigned *out = (unsigned *)&OUTA;         // RS350: OUTA
  *out |= 8;
  *parts[0] |= 8;
  *output() ^= 8;
  memset((void *)&OUTA, 255, sizeof OUTA);  // RS350: OUTA
  if (*(volatile unsigned *)&INA & 16) pause(5);  // RS350: INA
  parts[1] = PLACE(OUTA);  // RS350: OUTA
}
