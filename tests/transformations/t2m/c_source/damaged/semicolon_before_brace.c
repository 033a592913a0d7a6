#include "simpletools.h"

int twice(int x)
{
  return 2 * x}

int main()
{
  high(twice(2));
  pause(1);
}
