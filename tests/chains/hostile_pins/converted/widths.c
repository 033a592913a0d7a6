#include "simpletools.h"
#include <stdint.h>

enum side { LEFT, RIGHT, BOTH = 6 };
typedef struct {
  unsigned pin : 2;
  enum side side : 2;
  signed sign : 4;
  unsigned char narrow;
} bits;

bits listed = { 7, BOTH, 10, 260 };
bits rows[2] = { { .side = BOTH + 1 }, { 6 } };
unsigned char wide = 261;
static uint16_t shorts[] = { 65542 };
static unsigned char returned(void) { return 263; }
static void on(unsigned char given) { high(given); }
static void field(bits *at) { at->pin = LEFT + 4; }

int main(void) {
  bits local;
  const int seventeen = 17;
  local.sign = seventeen;
  field(&rows[0]);
  high(listed.pin);
  high(listed.side);
  high(local.sign);
  high(listed.narrow);
  high(wide);
  high(shorts[0]);
  high(returned());
  on(265);
  low((unsigned char)266);
  while (1) pause(100);
}
