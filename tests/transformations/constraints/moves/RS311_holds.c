#include "simpletools.h"
#include <stdint.h>
/* Platform functions take 32 bits, and so do long and int32_t; what comes out small fits; hexadecimal masks of 16 bits are unsigned. */
long far = 100000;
int32_t fixed = 1000000;
float real = 100000;
unsigned int mask = 0xFF00;
int percent = 100000 / 1000;
int lowest = -32768;
enum limit { NEAR = 10, FAR = 90000 } limit = FAR;

int main(void)
{
  pause(60000);
  far = far + 70000 + FAR;
  if (far > 40000) pause(1);
  for (int i = 0; i < 5; i++) freqout(4, 100, 38000);
}
