#include "simpletools.h"

int main()
{
  high(1)// on
  low(1);
}
