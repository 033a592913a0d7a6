#include "simpletools.h"
#include <stdint.h>
/* One operand of 32 bits is enough; what is cut to a byte keeps its low bits; values from outside may be small. */
unsigned char low;
int16_t half;
int reading;

int main(void)
{
  pause(60 * 1000L);
  pause(60 * (int32_t)1000);
  low = 400 * 400;
  half = (int16_t)(200 * 200);
  reading = ping_cm(8) * 1000;
  for (int i = 0; i < 6; i++) pause(i * 5000);
  reading = (300 * 300) & 0xFF;
  if (reading & (1 << 15)) pause(1);
  float far = 1000.0 * 1000;
  pause(100 * 300 + (int)far);
}
