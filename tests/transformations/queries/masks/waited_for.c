// ports 14 15
#include "simpletools.h"
enum { START = 14, STOP = 15 };
int main(void) {
  unsigned both = 1 << START | 1 << STOP;
  waitpne(both, both);
  waitpeq(1 << STOP, 1 << STOP);
}
