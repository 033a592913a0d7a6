// expect D9=1 D8=1 D7=2 D6=1
#include "simpletools.h"
struct led { int pin; int ms; };
struct pair { struct led one, two; };
void on(struct led l) { high(l.pin); pause(l.ms); low(l.pin); pause(2); }
void both(struct pair p) { on(p.one); on(p.two); }
struct led made(void) { return (struct led){1, 3}; }

int main() {
  struct led a = {0, 2};
  on(a);
  on(made());
  a = (struct led){2, 5};
  on(a);
  both((struct pair){{.ms = 4, .pin = 3}, {2, 2}});
  while (1);
}
