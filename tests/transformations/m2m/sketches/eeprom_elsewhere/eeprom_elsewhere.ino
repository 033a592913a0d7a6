#include "store.h"

void setup() {
  store(3);
}

void loop() {}
