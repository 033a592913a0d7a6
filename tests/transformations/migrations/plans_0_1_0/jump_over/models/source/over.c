#include "simpletools.h"

int check(int n)
{
  if (n < 0) goto failed;
  int twice = 2 * n;
  return twice;
failed:
  return -1;
}

int main()
{
  while (1) pause(check(3));
}
