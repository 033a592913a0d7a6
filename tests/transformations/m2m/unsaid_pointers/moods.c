#include "simpletools.h"
#include "moods.h"
void begin(void);
struct { void (*go)(); int n; } unnamed = { 0, 1 };
int angry(int c) { return c; }
int sad(int c) { return -c; }
void run(int a, float b) { print("%d\n", a + (int)b); }
void none(void) { pause(1); }
char *spelt(int a) { return a ? "a" : "b"; }
struct mood moods[2] = { { angry, run }, { sad, run } };
int (*table[2])() = { angry, sad };  // becomes int32_t (*table[2])(int32_t) = { angry, sad };
void (*quiet)() = none;  // becomes void (*quiet)() = none;
void (*other)(), (*handed)();  // becomes void (*other)(int32_t, float), (*handed)(int32_t, float);
const char *(*named)() = spelt;  // becomes const char *(*named)(int32_t) = (const char *(*)(int32_t))spelt;
void (*mixed)();  // told
void (*mixed_quietly)();
void (*never)();  // told
int (*converted)();  // told
void (*behind)();  // told
typedef struct { int a; } later_t;
void takes_later(later_t *l) { l->a = 1; }
void count(void) { none(); }
void (*counted)() = count;  // told
void each_of(void (*what)(int, float)) { what(1, 2); }

int main(void)
{
  struct mood m = moods[0];
  later_t l;
  int i = 0;
  begin();
  m.active(1, 2.0);
  (*m.active)(1, 2.0);  // becomes (*m.active)(1L, 2.0);
  print("%d %d\n", m.passive(3), table[1](4));
  m.passive();  // becomes m.passive(0);
  moods[1].active(7);  // becomes moods[1].active(7L, 0);
  table[0](5, 6);  // becomes table[0](5L);
  unnamed.go = none;  // becomes unnamed.go = none;
  unnamed.go(1);  // becomes unnamed.go();
  each(run);
  quiet();
  quiet(1, i);  // becomes quiet();
  counted(i++);  // refused
  other = run;
  handed = i ? other : 0;
  each_of(handed);
  handed(1, 2.0);
  mixed = i ? none : (void (*)())run;
  mixed(1);  // refused
  mixed_quietly = none;
  mixed_quietly = (void (*)())angry;
  mixed_quietly();
  if (never) never(3);  // refused
  converted = (int (*)())none;
  converted(1);  // refused
  behind = takes_later;
  behind(&l);  // refused
  shared("told");
  print("%s %d\n", named(1), sensors[1].read(3));
}
