#include "simpletools.h"
#include "lamp.h"
#include "dance.c"

int main() {
  while (1) {
    dance();
    blink(7);
  }
}
