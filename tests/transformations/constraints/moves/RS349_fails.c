#include "simpletools.h"
int main(void) {
  int n = sizeof(void *);  // RS349: sizeof(void *)
  print("%d\n", n);
}
