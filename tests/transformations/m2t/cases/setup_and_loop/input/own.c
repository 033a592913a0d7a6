#include "simpletools.h"

void setup(void) { high(1); }
void loop(void) { toggle(1); }
void init(int n) { pause(n); }

int main()
{
  setup();
  init(3);
  while (1) {
    loop();
  }
}
