#include "simpletools.h"
#include "ping.h"
#include "servo.h"

int main() {
  print("ready\n");
  while (1) {
    int distance = ping_cm(8);
    servo_angle(16, distance < 20 ? 0 : 900);
    high(26);
    pause(20);
  }
}
