#include <propeller.h>

int main(void)
{
  DIRA |= 1;
  CTRA = 4 << 26;  // RS320: CTRA
  FRQA = 53687;  // RS320: FRQA
  while (1) {
    OUTA ^= 1;
    waitcnt(CNT + CLKFREQ);
    PHSA = 0;  // RS320: PHSA
  }
}
