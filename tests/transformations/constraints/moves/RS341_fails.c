#include "simpletools.h"
/* Calls that give less than is taken, by a name that says nothing, through members, arrays and pointers to pointers. */
struct mood { int (*passive)(); void (*active)(); };
int wait(int ms) { pause(ms); return ms; }
void drive(int left, int right) { pause(left + right); }
int old(a) int a; { return a; }
struct mood calm = { wait, drive };
int (*table[2])() = { wait, wait };

int main(void)
{
  calm.passive();  // RS341: calm.passive()
  calm.active(1);  // RS341: calm.active(1)
  table[1]();  // RS341: table[1]()
  return old();  // RS341: old()
}
