#include "simpletools.h"

int main()
{
  high(1)
  low(2);
}
