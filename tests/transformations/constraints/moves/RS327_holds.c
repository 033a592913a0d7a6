#include "simpletools.h"
#define INA 6
int pins[3] = {4, 5, 6};
int chosen;

int main(void)
{
  chosen = 7;
  for (int i = 0; i < 3; i++) high(pins[i]);
  high(chosen);
  chosen = 8;
  high(chosen);
  for (chosen = 9; chosen <= 12; chosen++) low(chosen);
  OUTA |= 1 << 3;
  low(INA);
}
