#include "simpletools.h"

int main()
{
  high(26);
  while (1);
}
