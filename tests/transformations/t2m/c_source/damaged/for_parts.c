#include "simpletools.h"

int main()
{
  for (int i = 0; i < 3, i++) high(i);
  low(2);
}
