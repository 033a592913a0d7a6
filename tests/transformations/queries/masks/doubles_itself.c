// ports ?
#include "simpletools.h"
int main(void) {
  int n = 1;
  for (int i = 0; i < 3; i = i + i + 1) n += n;
  for (int k = n; k < 20; k += k) OUTA |= 1 << k;
}
