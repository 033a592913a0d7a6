#include "simpletools.h"
#include "abdrive.h"
#include "wheels.h"

void forward(int speed) {
  drive_speed(speed, speed);
  print("speed %d\n", speed);
}
