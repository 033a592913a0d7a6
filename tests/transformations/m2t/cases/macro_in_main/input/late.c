#include "simpletools.h"

int main()
{
#define COUNT 4
  int values[COUNT];
  int n = 0;
  while (1) {
    values[n % COUNT] = n;
    pause(values[0]);
  }
}
