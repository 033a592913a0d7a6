#include "simpletools.h"

int main(void) {
  pause(1);
  return 0;
}
