#include "simpletools.h"
#define MINUTE (60 * SECOND)
#define SECOND 1000
long far;
int pins[] = {3, 17};

int main(void)
{
  int wide = 3;
  unsigned int word;
  pause(60 * 1000);  // RS313: 60 * 1000
  pause(MINUTE);  // RS313: MINUTE
  for (int i = 0; i < 10; i++) pause(i * 5000);  // RS313: i * 5000
  for (int i = 0; i < 2; i++) set_outputs(31, 0, 1 << pins[i]);  // RS313: 1 << pins[i]
  word = 1 << 20;  // RS313: 1 << 20
  wide = wide + ((200 * 200) << 1);  // RS313: (200 * 200) << 1
  far = ping_cm(8);
  if (far & (1 << 15)) word = 1;  // RS313: 1 << 15
  word = (word << 1) | (word >> 31);  // RS313: word >> 31
}
