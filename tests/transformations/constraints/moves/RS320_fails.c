#include <propeller.h>

int main(void)
{
  DIRA |= 1;  // RS320: DIRA
  while (1) {
    OUTA ^= 1;  // RS320: OUTA
    waitcnt(CNT + CLKFREQ);  // RS320: CNT
  }
}
