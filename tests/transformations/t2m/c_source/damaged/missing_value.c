#include "simpletools.h"

int main()
{
  int x = ;
  x = ;
  high(x);
}
