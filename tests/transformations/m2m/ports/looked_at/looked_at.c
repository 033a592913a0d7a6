#include "simpletools.h"

const int printed = 10;  // => const int printed = 10;
const int plain = 11;  // => const int plain = 4;
const int compared = 12;  // => const int compared = 12;
int late;  // => int late;

enum { RED = 3, GREEN = 5 };  // => enum { RED = 6, GREEN = 7 };
enum { UP = 1, DOWN };  // => enum { UP = 255 /* P1 is not wired yet */, DOWN = 2 };
enum { WEST = 18, EAST, NORTH };  // => enum { WEST = A0, EAST = 255 /* P19 is not wired */, NORTH = 20 };

int pick(int left) {
  return left ? RED : GREEN;  // => return left ? RED : GREEN;
}

void pass(int pin, int on) {
  int same = pin;  // => int same = pin;
  if (on) high(same); else low(same);  // => if (on) high(same); else low(same);
}

int main() {
  int number, chosen;
  print("%d\n", printed);
  high(printed);  // => high(port(printed));
  pass(plain, 1);  // => pass(plain, 1);
  pass(15, 0);  // => pass(5, 0);
  if (number == compared) high(compared);  // => if (number == compared) high(port(compared));
  toggle(pick(1));  // => toggle(pick(1));
  scan("%d", &number);
  toggle(number);  // => toggle(port(number));
  for (number = 20; number < 23; number++) low(number);  // => for (number = 20; number < 23; number++) low(port(number));
  low(UP);  // => low(UP);
  low(WEST);  // => low(WEST);
  low(EAST);  // => low(EAST);
  late = 14;  // => late = 14;
  high(late);  // => high(port(late));
  chosen = number > 3 ? 16 : 17;  // => chosen = number > 3 ? 8 : 9;
  high(chosen);  // => high(chosen);
  (pause)(10);
}
