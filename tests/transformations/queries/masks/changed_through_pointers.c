// ports 3 5 7 8 9 10
#include "simpletools.h"
int first = 10, second = 5;
union { int whole; unsigned char low; } both = {9};

int change(int *what) {
  *what = 3;
  return 1;
}

int main() {
  int *other = &second;
  *other = 7;
  change(&first);
  OUTA |= 1 << first;
  OUTA |= 1 << second;
  both.low = 8;
  OUTA |= 1 << both.whole;
}
