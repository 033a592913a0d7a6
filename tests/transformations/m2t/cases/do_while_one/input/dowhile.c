#include "simpletools.h"

int main()
{
  int n = 0;
  do {
    n++;
    pause(n);
  } while (1);
}
