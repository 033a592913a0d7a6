/* Two wheels that run against each other, and a gripper that moves slowly. */
#include "simpletools.h"
#include "servo.h"

#define LEFT 12
#define RIGHT 13
#define GRIP 14

int main() {
  servo_speed(LEFT, 60);
  servo_speed(RIGHT, -60);
  servo_set(GRIP, 1000);
  pause(200);
  print("%d ", servo_setramp(GRIP, 20) > 1);
  servo_set(GRIP, 1200);
  pause(100);
  int half = servo_get(GRIP);
  print("%d ", half > 1040 && half < 1160);
  pause(300);
  print("%d %d\n", servo_get(GRIP), servo_setramp(9, 5));
  servo_speed(LEFT, 0);
  servo_speed(RIGHT, 0);
  pause(100);
  servo_stop();
}
