// ports 4 5 6 7 12
#include "simpletools.h"
int read_inputs(void) { return INA; }
int main(void) {
  int state = read_inputs();
  int row = state >> 4 & 0xF;
  if (state & 1 << 12) print("%d", row);
}
