#include "counter.h"

int count(void) {
  static int calls;
  return ++calls;
}
