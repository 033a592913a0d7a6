#include "simpletools.h"

void main(void)
{
  high(1);
  if (input(2)) return;
  low(1);
}
