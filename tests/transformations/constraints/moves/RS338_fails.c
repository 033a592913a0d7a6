#include "simpletools.h"
typedef long double ratio_t;  // RS338
long double first = 1.5L;  // RS338
ratio_t several[3];

float of(long double given)  // RS338
{
  return given;
}

int main(void)
{
  print("%d", (int)sizeof(long double));  // RS338
  pause(of((long double)several[0]));  // RS338
}
