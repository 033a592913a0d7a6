#include "simpletools.h"

typedef int (*reader)(int);
reader read_pin = input;

int main()
{
  while (1) pause(read_pin(3));
}
