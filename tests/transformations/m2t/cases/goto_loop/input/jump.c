#include "simpletools.h"

int main()
{
  int n = 0;
again:
  n++;
  pause(n);
  goto again;
}
