#include "simpletools.h"
#include <stdint.h>
/* Small factors say nothing; remainders and masks have a bound; 16 bits of two bytes into 16 bits are all of them. */
int ticks;
unsigned char bytes[2];
int16_t word;
long far;

int main(void)
{
  scan("%d", &ticks);
  pause(ticks * 10);
  pause((ticks % 30) * 1000);
  pause((ticks & 7) * 1000);
  word = (bytes[1] << 8) | bytes[0];
  pause(far * 1000);
}
