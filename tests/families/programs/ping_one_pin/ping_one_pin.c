/* A ranger with one pin: a warning lamp when something is near. */
#include "simpletools.h"
#include "ping.h"

int eye = 8;

int main() {
  for (int n = 0; n < 4; n++) {
    int cm = ping_cm(eye);
    set_direction(26, 1);
    set_output(26, cm < 30);
    print("%d %d %d\n", cm, ping(eye) / 10, ping_inches(eye));
    pause(100);
  }
}
