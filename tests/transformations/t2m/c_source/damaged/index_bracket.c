#include "simpletools.h"

int main()
{
  int a[3];
  high(a[1);
  low(a[2]);
}
