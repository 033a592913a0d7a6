/* A remote control: each key is told. */
#include "simpletools.h"
#include "sirc.h"

int main() {
  sirc_setTimeout(1000);
  while (1) {
    int key = sirc_button(10);
    if (key >= 0) print("key %d\n", key);
    pause(100);
  }
}
