#include "simpletools.h"

struct wheel { int pin; };

void turn(wheel *w)
{
  high(w.pin);
}

int main()
{
  struct wheel w;
  turn(&w);
}
