#include "simpletools.h"

#define FRONT input(7)  // => #define FRONT input(4)
#define LAMP 26  // => #define LAMP 13
#define ALSO_LAMP (LAMP)  // => #define ALSO_LAMP (LAMP)
#define LIGHT(p) high(p)  // => #define LIGHT(p) high(p)
#define BLINK(p, ms) do { high(p); pause(ms); low(p); } while (0)  // => #define BLINK(p, ms) do { high(p); pause(ms); low(p); } while (0)
#define SHOW(p) do { print("P%d\n", p); high(p); } while (0)  // => #define SHOW(p) do { print("P%d\n", p); high(port(p)); } while (0)
#define FIRST 10  // => #define FIRST 10
#define SECOND (FIRST + 1)  // => #define SECOND (FIRST + 1)
#define TESTED 8  // => #define TESTED 8
#if TESTED > 4
#define SPEED 2
#endif

int main() {
  if (FRONT) LIGHT(LAMP);  // => if (FRONT) LIGHT(LAMP);
  LIGHT(ALSO_LAMP);  // => LIGHT(ALSO_LAMP);
  BLINK(5, 100);  // => BLINK(7, 100);
  SHOW(6);  // => SHOW(6);
  high(SECOND);  // => high(port(SECOND));
  low(TESTED);  // => low(port(TESTED));
}
