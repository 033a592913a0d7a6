// 160 to 220
#include "simpletools.h"

struct robot {
  void (*step)(int);
};

void quick(void) { pause(40); }
void slow(void) { pause(60); pause(40); }
void beep(int n) { pause(120); }

void (*jobs[])(void) = {quick, slow};
struct robot robot = {beep};

int main() {
  int i = 0;
  while (1) {
    toggle(26);
    jobs[i % 2]();
    robot.step(1);
    i++;
  }
}
