#include "simpletools.h"
/* Doubles and floats have 4 bytes here and there, long long has 8; a pointer to a long double holds none. */
double first = 1.5;
float second;
long long third;
long double *nothing;

int main(void)
{
  second = (double)third + first;
  pause(nothing == 0);
}
