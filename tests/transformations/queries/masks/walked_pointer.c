// ports 3 6 8
#include "simpletools.h"
static char pins[] = {3, 6, 8};
int main(void) {
  char *p = pins;
  for (int n = 0; n < 3; n++) DIRA |= 1 << *p++;
  for (p = pins; p != pins + 3; p++) { OUTA = 1 << *p; pause(5); }
}
