#include "simpletools.h"

void after_loop(void) { toggle(1); }

int main()
{
  int tries = 0;
again:
  tries++;
  int level = 7;
  if (tries < 3) goto again;
  while (1) {
    level--;
    while (input(3)) {
      if (level) break;            // of the inner loop
    }
    switch (level) {
      case 3: break;
      case 2: continue;            // of main's loop
    }
    if (level == 1) {
      break;                       // of main's loop
    }
    if (level < 0) return input(2);
    after_loop();
  }
  // behind the loop
  print("%d %d\n", tries, level);
  while (1) toggle(level);
}
