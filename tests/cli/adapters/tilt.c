#include "simpletools.h"
#include "mx2125.h"

int main() {
  while (1) {
    int acceleration = mx_accel(5);
    int tilt = mx_tilt(6);
    pause(acceleration + tilt);
  }
}
