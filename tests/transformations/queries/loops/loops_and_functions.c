// 130 to 130
#include "simpletools.h"
#define STEP 20
const int times = 5;
void wait_some(int milliseconds) { pause(milliseconds); }
int main() {
  pause(200);
  for (;;) {
    toggle(26);
    for (int i = 0; i < times; i++) pause(STEP);
    wait_some(30);
  }
}
