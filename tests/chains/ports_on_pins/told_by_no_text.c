#include "simpletools.h"
#define SHOWN(...) print("%d %d\n", __VA_ARGS__); set_output(__VA_ARGS__); set_direction(__VA_ARGS__)
#define FIVE(name) name##high(5)
#define READ(...) (print("%d", __VA_ARGS__), input(__VA_ARGS__))
#define RANGE(...) print("%d %d", __VA_ARGS__, 0); set_outputs(__VA_ARGS__, 3); set_directions(__VA_ARGS__, 3)
#define OPEN(...) print("%d %d", __VA_ARGS__); bus = i2c_newbus(__VA_ARGS__, 0)
i2c *bus;
int numbers;
void thigh(int n) { numbers += n; }
int help(void) {
  if (READ(3)) { FIVE(); FIVE(t); }
  return READ(4) + 1;
}
int main(void)
{
SHOWN(11, 1);
  FIVE(t); FIVE(); high(7);
  OPEN(2, 12);
  RANGE(9, 8);
  while (1) {
    FIVE();  // here
    if (help()) SHOWN(6,
       1) ;
    pause(10); }
}
