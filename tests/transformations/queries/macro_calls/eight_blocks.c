#include "simpletools.h"

#define B0(x) high(x)
#define B1(x) do { B0(x); B0((x) + 1); } while (0)
#define B2(x) do { B1(x); B1((x) + 2); } while (0)
#define B3(x) do { B2(x); B2((x) + 4); } while (0)
#define B4(x) do { B3(x); B3((x) + 8); } while (0)
#define B5(x) do { B4(x); B4((x) + 16); } while (0)
#define B6(x) do { B5(x); B5((x) + 32); } while (0)
#define B7(x) do { B6(x); B6((x) + 64); } while (0)
#define B8(x) do { B7(x); B7((x) + 128); } while (0)

int main()
{
  B8(0);
  return 0;
}
