#include "simpletools.h"
#include "abdrive.h"
#include "wheels.h"

int main() {
  drive_setRampStep(4);
  while (1) {
    forward(64);
    pause(1000);
    drive_speed(0, 0);
    print("stands\n");
  }
}
