#include "simpletools.h"

int main()
{
  int n = 5;
  int values[n];
  while (1) {
    values[0] = n;
    pause(values[0]);
  }
}
