#include "simpletools.h"

int main(void)
{
  unsigned OUTB = 0, *copy = &OUTB;
  unsigned seen = (unsigned)INA & OUTA;
  DIRA |= 8;
  OUTA = *copy & seen;
}
