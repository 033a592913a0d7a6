#include "simpletools.h"

#define B0(x) high(x)
#define B1(x) B0(x); B0(x + 1)
#define B2(x) B1(x); B1(x + 2)
#define B3(x) B2(x); B2(x + 4)
#define B4(x) B3(x); B3(x + 8)
#define B5(x) B4(x); B4(x + 16)
#define B6(x) B5(x); B5(x + 32)
#define B7(x) B6(x); B6(x + 64)
#define B8(x) B7(x); B7(x + 128)

int main()
{
  B8(0);
  return 0;
}
