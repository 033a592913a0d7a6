#include <stdio.h>
typedef struct { void (*start)(void); int led; int wait; } handlers;
typedef struct { int led; handlers at; char *name; } robot;
enum mode { OFF, ON };
struct state { enum mode now; unsigned char level; short list[3]; };
static void begin(void) { printf("begin\n"); }
void blink();
handlers whole = { .start = begin, .led = 1, .wait = 2 };
robot apart = { name: "apart", at: { wait: 3, start: begin } };
void (*starts[3])(void) = { [2] = begin };
int main()
{
  int x = 300;
  handlers old = { start: begin, led: 4, wait: 100 };
  handlers turned = { wait: 50, start: begin };
  handlers some = { .start = begin, .wait = 3 };
  robot first = { .at = { .start = begin, .led = 7 }, .led = x };
  robot second = { led: x, at: { start: begin }, name: "Bob" };
  robot third = { .at.led = 9, .at.start = begin };
  struct state set = { now: 1, level: x, list: { [1] = x } };
  whole.start(); apart.at.start(); starts[2](); old.start(); turned.start(); some.start();
  first.at.start(); second.at.start(); third.at.start();
  printf("%d %d %d %s\n", whole.led, whole.wait, apart.at.wait, apart.name);
  printf("%d %d %d %d\n", old.led, old.wait, turned.wait, some.wait);
  printf("%d %d %d %s %d\n", first.at.led, first.led, second.led, second.name, third.at.led);
  printf("%d %d %d %d\n", set.now, set.level, set.list[0], set.list[1]);
  blink();
  blink(2);
  return 0;
}
void blink(int times) { printf("blink\n"); (void)times; }
