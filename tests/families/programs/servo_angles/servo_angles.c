/* A standard servo that sweeps and is let go, and tells its pulses. */
#include "simpletools.h"
#include "servo.h"

int arm = 16;

int main() {
  print("%d ", servo_angle(arm, 0) > 1);
  pause(300);
  for (int angle = 900; angle <= 1800; angle += 900) {
    print("%d ", servo_angle(arm, angle));
    pause(300);
  }
  print("%d ", servo_get(arm));
  servo_disable(arm);
  pause(300);
  print("%d\n", servo_get(arm));
}
