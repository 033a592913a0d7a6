#include "simpletools.h"
#include "macros.h"
#define ANY(...) high(__VA_ARGS__); pause(10)
#define THROUGH(first, rest...) ANY(first); ANY(rest)
#define ALWAYS ANY(12)
#define CAT(a, b) a##b
#define PIN CAT(1, 4)
#define LEVEL(how, p) CAT(how, gh)(p); pause(10)
#define SET(what, p) what##_output(p, 1); pause(10)
#define GET(_1, _2, NAME, ...) NAME
#define ON1(a) do { print("on " #a " %d\n", a); high(a); pause(10); } while (0)
#define ON2(a, b) ON1(a); ON1(b)
#define ON(...) GET(__VA_ARGS__, ON2, ON1)(__VA_ARGS__)
#define PICK(first) ((first) ? 20 : 21)
#define BRACED(p) (high)((p)); pause(10)
#define WRAP(x) do { x; } while (0)
#define LAMPS X(RED, 22) X(GREEN, 23)
#define X(name, pin) int led_##name = pin;
LAMPS
#undef X
#define X(name, pin) high(led_##name); pause(10);

int main() {
  THROUGH(26, 4);
  ALWAYS;
  high(PIN);
  pause(10);
  LEVEL(hi, 5);
  set_direction(6, 1);
  SET(set, 6);
  CAT(hi, gh)(10);
  pause(10);
  ON(8);
  ON(16, 11);
  WRAP(ANY(PICK(0)));
  BRACED(FRONT);
  LAMPS
  while (1);
}
