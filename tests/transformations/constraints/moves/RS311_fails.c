#include "simpletools.h"
#define BAUD 115200
int speed = 40000;  // RS311: 40000
int table[] = {1, 70000};  // RS311: 70000
unsigned int colour;
enum limit { NEAR = 10, FAR = 90000 };
int take(int x) { return x; }

int main(void)
{
  int frequency;
  frequency = BAUD;  // RS311: BAUD
  colour = 0xFFFFFF;  // RS311: 0xFFFFFF
  speed = FAR;  // RS311: FAR
  take(-50000);  // RS311: 50000
  take((40000 + 40000) / 2);  // RS311: 40000
  frequency = ping_cm(8);
  if (speed > 65536) high(1);  // RS311: 65536
  speed += 100000;  // RS311: 100000
}
