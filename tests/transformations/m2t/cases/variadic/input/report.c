#include "simpletools.h"
#include <stdarg.h>

int total(int n, ...)
{
  int i, sum = 0;
  va_list values;
  va_start(values, n);
  for (i = 0; i < n; i++) sum += va_arg(values, int);
  va_end(values);
  return sum;
}

int main()
{
  print("start\n");
  while (1) {
    print("%d and %d%c", total(2, 3, 4), total(0), CLREOL);
    printi("%x\n", 15);
    pause(1000);
  }
}
