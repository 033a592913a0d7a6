// ports 10 11 20
#include "simpletools.h"
#define BIT(n) (1u << (n))
enum { RED = 10, GREEN };
#define BUTTON BIT(20)
int is_down(void) { return (INA & BUTTON) != 0; }
void lamp(unsigned bits, int on) { OUTA = on ? OUTA | bits : OUTA & ~bits; }
int main(void) {
  DIRA = BIT(RED) + BIT(GREEN);
  while (1) { lamp(BIT(RED), is_down()); lamp(BIT(GREEN), !is_down()); }
}
